#include <gtest/gtest.h>

#include <string_view>

#include "welkin/filter/sampler.h"
#include "welkin/prefilter/prefilter_cases.h"
#include "welkin/sphere/convention.h"

/// What any convolution keeps: constants, energy, sign, sums, rotations.
namespace welkin {
namespace {

using namespace prefilter_cases;

/// Wide, kinked, narrow, widened, a ring and a mirror.
std::vector<PrefilterLevel> levels_of(ChartSize size) {
  std::vector<PrefilterLevel> levels;
  for (const char* spec :
       {"lambert", "ggx,roughness=0.5", "ggx,roughness=0.02", "charlie", "ggx,roughness=0"})
    levels.push_back({size, AnyLobe::make(spec)});
  return levels;
}

std::vector<Map> run(const Map& source, const std::string& target, ChartSize size,
                     const PrefilterOptions& options = {}) {
  return prefilter_map(source, AnyParameterization::make(target), levels_of(size), options);
}

struct Shape {
  std::string parameterization;
  int width, height;
};

/// Every registered one that shows the whole world, and odd sizes.
std::vector<Shape> whole_worlds() {
  std::vector<Shape> list{{"latlong", 64, 32}, {"latlong", 63, 31},    {"latlong", 12, 50},
                          {"latlong", 128, 8}, {"latlong", 4, 2},      {"latlong", 2, 1},
                          {"latlong", 1, 1},   {"latlong", 3, 1},      {"cube", 1, 1},
                          {"cube", 17, 17},    {"octahedral", 32, 32}, {"octahedral", 33, 33}};
  for (const std::string& name : sphere::parameterization_names()) {
    const Map map = cases::make_map(name, 16);
    if (map.parameterization.whole_world()) list.push_back({name, map.width(), map.height()});
  }
  return list;
}

double furnace(const Map& level, double value) {
  double worst = 0;
  for_each_value(level, [&](double each) { worst = std::max(worst, std::fabs(each / value - 1)); });
  return worst;
}

/// A level can be looked up as it comes: beside the charts' edges, where kernels read the borders, a constant
/// is the constant too, to the furnace's 5e-4 at the default tolerance.
TEST(PrefilterLaws, AConstantMapIsConstantInLookUpsBesideEdges) {
  for (const char* target : {"cube", "octahedral", "latlong", "healpix", "eac", "sphere"}) {
    const Map source = filled("latlong", 32, 16, 2.0f);
    const Map shape = cases::make_map(target, 8);
    const ChartSize size{shape.width(), shape.height()};
    for (const Map& level : run(source, target, size)) {
      std::vector<Vec3d> directions;
      for (int chart = 0; chart < level.charts(); ++chart) {
        for (int i = 0; i <= 16; ++i) {
          for (const double edge : {1e-3, 0.999}) {
            directions.push_back(level.parameterization.to_sphere(chart, i / 16.0, edge));
            directions.push_back(level.parameterization.to_sphere(chart, edge, i / 16.0));
          }
        }
      }
      std::vector<float> values(directions.size());
      for (const Filter filter : {Filter::bilinear, Filter::bicubic, Filter::lanczos}) {
        Sampler::borrow(level, {.filter = filter}).look_up(directions, values);
        for (const float value : values) EXPECT_NEAR(value, 2, 1e-3) << target;
      }
    }
  }
}

/// PrefilterOptions::borders: the same levels, their borders left at 0.
TEST(PrefilterLaws, BordersCanBeLeftToTheCaller) {
  const Map source = landscape("latlong", 32, 16);
  PrefilterOptions without;
  without.borders = false;
  std::vector<Map> filled_ones = run(source, "cube", {8, 8}), bare = run(source, "cube", {8, 8}, without);
  for (std::size_t i = 0; i < bare.size(); ++i) {
    EXPECT_EQ(*bare[i].level.chart(2).at(-1, 3), 0);
    fill_borders(bare[i]);
    for (int y = -kBorder; y < 8 + kBorder; ++y) {
      for (int x = -kBorder; x < 8 + kBorder; ++x)
        EXPECT_EQ(*bare[i].level.chart(2).at(x, y), *filled_ones[i].level.chart(2).at(x, y));
    }
  }
}

/// As near as one asks for: 1e-5 at a tolerance of 2e-5; 5e-5 with rims that reach far along meridians
/// (mirror balls) and rows of half texels at a pole.
TEST(PrefilterLaws, AConstantMapStaysConstant) {
  for (const Shape& shape : thinned(whole_worlds())) {
    const Map source = filled(shape.parameterization, shape.width, shape.height, 3.0f);
    std::vector<PrefilterLevel> levels;
    for (const char* spec : {"ggx,roughness=0.35", "vmf,kappa=40"})
      levels.push_back({{9, 9}, AnyLobe::make(spec)});
    PrefilterOptions options;
    options.tolerance = 2e-5;
    const std::vector<Map> results =
        prefilter_map(source, AnyParameterization::make("cube"), levels, options);
    for (std::size_t i = 0; i < levels.size(); ++i) {
      const std::string& name = shape.parameterization;
      const bool hard = !source.parameterization.full_charts() || name.starts_with("octahedral") ||
                        name.starts_with("openexr");
      EXPECT_LT(furnace(results[i], 3), hard ? 5e-5 : 1e-5)
          << shape.parameterization << ' ' << shape.width << ' ' << levels[i].lobe.spec();
    }
  }
}

/// A lobe alone gets a grid that is just fine enough for its tolerance, 1e-3. Coarse mirror balls, of which
/// one texel of the rim is the world behind from pole to pole: 2e-3.
TEST(PrefilterLaws, AConstantMapStaysConstantWithinTheToleranceOfOneLobe) {
  std::size_t which = 0;
  const std::vector<AnyLobe> all = lobes();
  for (const Shape& shape : thinned(whole_worlds())) {
    const Map source = filled(shape.parameterization, shape.width, shape.height, 3.0f);
    for (std::size_t i = which++ % 11; i < all.size(); i += 11) {
      const Map level =
          std::move(prefilter_map(source, AnyParameterization::make("cube"), {{{9, 9}, all[i]}}).front());
      EXPECT_LT(furnace(level, 3), 2e-3)
          << shape.parameterization << ' ' << shape.width << ' ' << all[i].spec();
    }
  }
}

/// ∫ of a level that is fine beside the lobe, by its texels, is the source's: 1e-4.
TEST(PrefilterLaws, EnergyIsKept) {
  for (const Shape& shape : thinned<Shape>({{"latlong", 64, 32},
                                            {"latlong", 31, 21},
                                            {"cube", 16, 16},
                                            {"octahedral", 31, 31},
                                            {"octahedral", 32, 32},
                                            {"fisheye-equidistant", 32, 32},
                                            {"paraboloid", 24, 24},
                                            {"mirror-ball", 32, 32}})) {
    const Map source = landscape(shape.parameterization, shape.width, shape.height);
    const PrefilterReference reference(source);
    const std::vector<PrefilterLevel> levels = levels_of({192, 96});
    const std::vector<Map> results = run(source, "latlong", {192, 96});
    for (std::size_t i = 0; i < results.size(); ++i) {
      if (levels[i].lobe.is_mirror()) continue;
      double sum = 0;
      for (int y = 0; y < 96; ++y) {
        const double ring = 2 * kPi / 192 * (std::cos(y * kPi / 96) - std::cos((y + 1) * kPi / 96));
        for (int x = 0; x < 192; ++x) sum += ring * static_cast<double>(*results[i].level.chart(0).at(x, y));
      }
      EXPECT_NEAR(sum / reference.integral()[0], 1, 1e-4)
          << shape.parameterization << ' ' << levels[i].lobe.spec();
    }
  }
}

TEST(PrefilterLaws, PositiveMapsStayPositiveAndBlackOnesBlack) {
  for (const Shape& shape : {Shape{"latlong", 64, 32}, {"cube", 16, 16}, {"fisheye-equidistant", 32, 32}}) {
    const Map black = filled(shape.parameterization, shape.width, shape.height, 0, 3);
    for (const Map& level : run(black, "cube", {8, 8}))
      for_each_value(level, [](double value) { EXPECT_EQ(value, 0); });
    for (const float sun : {1e5f, 1e30f}) {
      for (const int x : {0, 5}) {
        Map map = filled(shape.parameterization, shape.width, shape.height, 1e-3f);
        *map.level.chart(0).at(map.width() / 2 + x, map.height() / 2) = sun;
        fill_borders(map);
        for (const Map& level : run(map, "octahedral", {16, 16}))
          for_each_value(level, [&](double value) { EXPECT_TRUE(value >= 0 && value <= sun) << value; });
      }
    }
  }
}

/// The largest difference of two levels, over the largest value.
double difference(const Map& a, const Map& b, double factor = 1) {
  double maximum = 0, worst = 0;
  cases::for_each_valid_texel(a, [&](int chart, int x, int y) {
    for (int c = 0; c < a.channels(); ++c) {
      const double p = static_cast<double>(a.level.chart(chart).at(x, y)[c]);
      const double q = factor * static_cast<double>(b.level.chart(chart).at(x, y)[c]);
      maximum = std::max(maximum, std::fabs(p));
      worst = std::fabs(p - q) <= worst ? worst : std::fabs(p - q);
    }
  });
  return worst / maximum;
}

template <class Body>
void change(Map& map, const Body& body) {
  cases::for_each_valid_texel(map, [&](int chart, int x, int y) {
    for (int c = 0; c < map.channels(); ++c) {
      float& value = map.level.chart(chart).at(x, y)[c];
      value = body(value);
    }
  });
  fill_borders(map);
}

/// Signs pass through: rounding. A mirror's kernel is clamped for positive light (filter/fetch.h).
TEST(PrefilterLaws, NegativeRadianceIsConvolvedToo) {
  for (const Shape& shape : {Shape{"latlong", 64, 32}, {"cube", 16, 16}}) {
    Map source = landscape(shape.parameterization, shape.width, shape.height);
    const std::vector<Map> positive = run(source, "cube", {8, 8});
    change(source, [](float value) { return -value; });
    const std::vector<Map> negative = run(source, "cube", {8, 8});
    for (std::size_t i = 0; i < positive.size(); ++i) {
      if (levels_of({8, 8})[i].lobe.is_mirror()) continue;
      EXPECT_LT(difference(positive[i], negative[i], -1), 1e-6) << levels_of({8, 8})[i].lobe.spec();
    }
  }
}

/// A map of both signs against brute force.
TEST(PrefilterLaws, MixedSignsAreConvolvedToo) {
  Map source = landscape("latlong", 64, 32);
  change(source, [](float value) { return value - 1; });
  const PrefilterReference reference(source);
  for (const char* lobe : {"ggx,roughness=0.5", "phong,exponent=20"}) {
    const Map level = prefiltered(source, "cube", {8, 8}, lobe);
    EXPECT_LT(errors_of(level, reference, AnyLobe::make(lobe), 5).relative_rmse, 2e-3) << lobe;
  }
}

/// A power of two changes exponents alone, so long as nothing overflows; and so does the choice of bright
/// points not depend on the exposure.
TEST(PrefilterLaws, ExposureIsAFactor) {
  for (const Shape& shape : {Shape{"latlong", 64, 32}, {"cube", 16, 16}}) {
    Map source = landscape(shape.parameterization, shape.width, shape.height);
    const std::vector<Map> plain = run(source, "cube", {8, 8});
    for (const int stops : {-60, 60}) {
      Map exposed = landscape(shape.parameterization, shape.width, shape.height);
      change(exposed, [&](float value) { return std::ldexp(value, stops); });
      const std::vector<Map> results = run(exposed, "cube", {8, 8});
      for (std::size_t i = 0; i < plain.size(); ++i)
        EXPECT_LT(difference(plain[i], results[i], std::ldexp(1, -stops)), 1e-6)
            << stops << ' ' << levels_of({8, 8})[i].lobe.spec();
    }
  }
}

/// The levels of a sum of two maps are the sums of their levels, as far as the tolerance goes: their bright
/// points differ.
TEST(PrefilterLaws, SumsOfMapsAreSumsOfLevels) {
  Map a = landscape("latlong", 64, 32), b = landscape("latlong", 64, 32, 1, 9),
      sum = landscape("latlong", 64, 32);
  for (int i = 0; i < 64 * 32; ++i)
    *sum.level.chart(0).at(i % 64, i / 64) += *b.level.chart(0).at(i % 64, i / 64);
  fill_borders(sum);
  const std::vector<Map> of_a = run(a, "cube", {8, 8}), of_b = run(b, "cube", {8, 8}),
                         of_sum = run(sum, "cube", {8, 8});
  for (std::size_t i = 0; i < of_a.size(); ++i) {
    if (levels_of({8, 8})[i].lobe.is_mirror()) continue;
    double squares = 0, errors = 0;
    cases::for_each_valid_texel(of_a[i], [&](int chart, int x, int y) {
      const auto at = [&](const Map& map) { return static_cast<double>(*map.level.chart(chart).at(x, y)); };
      squares += at(of_sum[i]) * at(of_sum[i]);
      errors += std::pow(at(of_sum[i]) - at(of_a[i]) - at(of_b[i]), 2);
    });
    EXPECT_LT(std::sqrt(errors / squares), 1e-3) << levels_of({8, 8})[i].lobe.spec();
  }
}

/// The same picture in another program's world: the levels in that world are the same too, and those in ours
/// are rotated.
TEST(PrefilterLaws, OrientationsOfSourceAndResultCancel) {
  const Map plain = landscape("cube", 12, 12);
  const std::vector<Map> expected = run(plain, "cube", {8, 8});
  for (const Convention& convention : thinned(conventions())) {
    Map turned = landscape("cube", 12, 12);
    turned.orientation = convention.lookup;
    PrefilterOptions options;
    options.orientation = convention.lookup;
    const std::vector<Map> results = run(turned, "cube", {8, 8}, options);
    for (std::size_t i = 0; i < results.size(); ++i)
      EXPECT_LT(difference(expected[i], results[i]), 1e-6) << convention.name;
    // In our world: each texel's direction, in the source's frame, against brute force.
    const Map native = prefiltered(turned, "latlong", {16, 8}, "ggx,roughness=0.5");
    EXPECT_LT(
        errors_of(native, PrefilterReference(turned), AnyLobe::make("ggx,roughness=0.5"), 3).relative_rmse,
        1e-3)
        << convention.name;
  }
}

/// A lat-long picture shifted by whole columns, to a level shifted by as many of its own: rounding.
TEST(PrefilterLaws, LongitudeIsNothingSpecial) {
  for (const int width : {64, 48}) {
    const Map source = landscape("latlong", width, 32);
    Map shifted = landscape("latlong", width, 32);
    const int by = width / 8;
    for (int i = 0; i < width * 32; ++i)
      *shifted.level.chart(0).at((i % width + by) % width, i / width) =
          *source.level.chart(0).at(i % width, i / width);
    fill_borders(shifted);
    const std::vector<Map> a = run(source, "latlong", {16, 8}), b = run(shifted, "latlong", {16, 8});
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (levels_of({16, 8})[i].lobe.is_mirror()) continue;
      Map back(a[i].parameterization, 16, 8, 1);
      for (int k = 0; k < 128; ++k)
        *back.level.chart(0).at(k % 16, k / 16) = *b[i].level.chart(0).at((k % 16 + 2) % 16, k / 16);
      EXPECT_LT(difference(a[i], back), 1e-5) << width << ' ' << levels_of({16, 8})[i].lobe.spec();
    }
  }
}

/// ∫ w L dω is the average times ∫ w dω.
TEST(PrefilterLaws, IntegralsAreAveragesTimesTheLobesIntegral) {
  const Map source = landscape("latlong", 32, 16);
  PrefilterOptions options;
  options.scale = LobeScale::integral;
  const std::vector<Map> averages = run(source, "cube", {4, 4}),
                         integrals = run(source, "cube", {4, 4}, options);
  for (std::size_t i = 0; i < averages.size(); ++i) {
    const AnyLobe lobe = levels_of({4, 4})[i].lobe;
    EXPECT_LT(difference(integrals[i], averages[i], lobe.is_mirror() ? 1 : lobe.integral()), 1e-6)
        << lobe.spec();
  }
}

}  // namespace
}  // namespace welkin
