/// Filter::automatic keeps light: what a source's texel sends, the target sends.

#include <gtest/gtest.h>

#include <utility>

#include "welkin/filter/resample_cases.h"
#include "welkin/map/borders.h"
#include "welkin/map/map_cases.h"
#include "welkin/map/texel_points.h"
#include "welkin/math/angles.h"

namespace welkin {
namespace {

using namespace cases;

constexpr float kDark = 0.25f, kLight = 1000;

/// ∫ (radiance − kDark) dω.
double light_of(const Map& map) {
  double sum = 0;
  const ChartSize size{map.width(), map.height()};
  for (int chart = 0; chart < map.charts(); ++chart) {
    for (int y = 0; y < map.height(); ++y) {
      const std::vector<double> omega = summed_solid_angles(map.parameterization, size, chart, y);
      const float* row = map.level.chart(chart).row(y);
      for (int x = 0; x < map.width(); ++x)
        sum += omega[static_cast<std::size_t>(x)] * static_cast<double>(row[x] - kDark);
    }
  }
  return sum;
}

void fill(Map& map, float value) {
  for (int chart = 0; chart < map.charts(); ++chart) {
    for (int y = 0; y < map.height(); ++y) std::fill_n(map.level.chart(chart).row(y), map.width(), value);
  }
}

// A source that shows a part of the sphere sends what it shows and no more, whether that is a strip of an
// eighth of a target's texel, found by 32×32 points, or a disc far from most texels.
TEST(ResampleParts, OfTheSphereSendTheirSolidAngle) {
  for (const char* name : {"latlong,left=1,right=1.703125", "latlong,left=20,right=100,top=50,bottom=-35",
                           "fisheye-equidistant,fov=60", "sky-latlong", "half-cube"}) {
    const auto p = sphere::AnyParameterization::make(name);
    Map source(p, 32, 32, 1), target(sphere::AnyParameterization::make("latlong"), 64, 32, 1);
    fill(source, 1 + kDark);
    fill_borders(source);
    ResampleOptions options;
    options.fill = {kDark};
    resample(source, target, options);
    EXPECT_NEAR(light_of(target), p.coverage(), 0.01 * p.coverage()) << name;
  }
}

/// A dark map with one lit texel.
Map with_light(const std::string& name, int size, int chart, int x, int y) {
  Map map = make_map(name, size);
  fill(map, kDark);
  *map.level.chart(chart).at(x, y) = kLight;
  fill_borders(map);
  return map;
}

/// Of a texel that is valid to its corners: what lies half outside has no defined light.
bool is_inside(const Map& map, int chart, int x, int y) {
  for (int k = 0; k < 4; ++k) {
    if (!map.parameterization.valid(chart, static_cast<double>(x + k % 2) / map.width(),
                                    static_cast<double>(y + k / 2) / map.height()))
      return false;
  }
  return true;
}

struct Lit {
  int chart, x, y;
};

/// Texels at corners, sides and the middle of a chart, and between.
std::vector<Lit> some_texels(const Map& map) {
  const int right = map.width() - 1, bottom = map.height() - 1, last = map.charts() - 1;
  std::vector<Lit> texels;
  for (const Lit& each : {Lit{0, 0, 0}, Lit{last, right, bottom}, Lit{0, right, bottom / 3},
                          Lit{last, right / 3, 0}, Lit{last / 2, right / 2, bottom / 2},
                          Lit{0, right / 2 + 1, bottom / 2 + 1}, Lit{last / 2, right / 5, 2 * bottom / 3}}) {
    if (is_inside(map, each.chart, each.x, each.y)) texels.push_back(each);
  }
  return texels;
}

class ResampleEnergyTest : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(All, ResampleEnergyTest, ::testing::ValuesIn(names_and_windows()), test_name);

/// How exactly the light of one texel is kept. Full charts are exact
/// but for densities that are not even within a texel: of maps of 40 texels, across the kinks of octahedra.
/// Rims are found by points.
double tolerance(const Map& source, const Map& target) {
  const auto kinked = [](const Map& map) { return map.parameterization.name().starts_with("octahedral"); };
  const bool full = source.parameterization.full_charts() && target.parameterization.full_charts();
  if (target.parameterization.filled_to_edges()) return 0.3;
  if (!full) return 0.1;
  return kinked(source) || kinked(target) ? 1.2e-2 : 3e-3;
}

TEST_P(ResampleEnergyTest, OneTexelKeepsItsLight) {
  // Texels of edge-centred maps repeat at edges: one alone is no map of theirs.
  if (GetParam().starts_with("openexr") || GetParam() == "fisheye-orthographic") return;
  const Map shape = make_map(GetParam(), 40);
  if (!shape.parameterization.whole_world()) return;
  for (const Lit& lit : some_texels(shape)) {
    const Map source = with_light(GetParam(), 40, lit.chart, lit.x, lit.y);
    for (const auto& [name, size] :
         {std::pair("latlong", 63), {"cube", 16}, {"cube", 40}, {"octahedral", 41}}) {
      Map target = make_map(name, size);
      for (const bool turned : {false, true}) {
        ResampleOptions options = with(Filter::automatic);
        if (turned) options.rotation = rotation_from_yaw_pitch_roll(31, 17, -8);
        resample(source, target, options);
        EXPECT_NEAR(light_of(target) / light_of(source), 1, tolerance(source, target))
            << name << ' ' << size << (turned ? " turned, " : ", ") << lit.chart << ' ' << lit.x << ','
            << lit.y;
        for (int chart = 0; chart < target.charts(); ++chart) {
          for (int y = 0; y < target.height(); ++y) {
            const float* row = target.level.chart(chart).row(y);
            EXPECT_GE(*std::min_element(row, row + target.width()), 0) << name;
          }
        }
      }
    }
  }
}

TEST_P(ResampleEnergyTest, LightArrivesEverywhere) {
  if (GetParam().starts_with("openexr")) return;
  for (const char* from : {"latlong", "cube"}) {
    const Map shape = make_map(from, 40);
    for (const Lit& lit : some_texels(shape)) {
      const Map source = with_light(from, 40, lit.chart, lit.x, lit.y);
      Map target = make_map(GetParam(), 50);
      if (!target.parameterization.whole_world()) return;
      ResampleOptions options = with(Filter::automatic);
      options.rotation = rotation_from_yaw_pitch_roll(-50, 20, 10);
      resample(source, target, options);
      EXPECT_NEAR(light_of(target) / light_of(source), 1, tolerance(source, target))
          << from << ' ' << lit.chart << ' ' << lit.x << ',' << lit.y;
    }
  }
}

TEST_P(ResampleEnergyTest, AConstantStaysConstant) {
  Map source = make_map(GetParam(), 40);
  fill(source, 0.7f);
  fill_borders(source);
  for (const char* name : {"latlong", "cube", "sphere"}) {
    for (const int size : {11, 43}) {
      Map target = make_map(name, size);
      ResampleOptions options = with(Filter::automatic);
      options.rotation = rotation_from_yaw_pitch_roll(31, 17, -8);
      options.fill = {0.7f};
      resample(source, target, options);
      for_each_valid_texel(target, [&](int chart, int x, int y) {
        EXPECT_NEAR(*target.level.chart(chart).at(x, y), 0.7f, 0.7e-6f) << name << ' ' << x << ',' << y;
      });
    }
  }
}

/// A texel inside a window keeps its light, from it and to it, with square texels and others.
TEST(ResampleEnergyTest, WindowsKeepTheLightOfTexelsInside) {
  for (const std::string& spec : windows()) {
    const auto p = sphere::AnyParameterization::make(spec);
    if (p.coverage() < 0.1) continue;  // finer than all targets here
    for (const ChartSize size : {ChartSize{60, 40}, {30, 90}}) {
      Map window(p, size.width, size.height, 1);
      for (const auto& [name, other_size] : {std::pair("latlong", 63), {"cube", 40}, {"octahedral", 41}}) {
        Map other = make_map(name, other_size);
        ResampleOptions options = with(Filter::automatic);
        options.fill = {kDark};
        const int x = size.width / 3, y = size.height / 4;
        fill(window, kDark);
        *window.level.chart(0).at(x, y) = kLight;
        fill_borders(window);
        const double inside = light_of(window);
        resample(window, other, options);
        EXPECT_NEAR(light_of(other) / inside, 1, name[0] == 'o' ? 1.2e-2 : 3e-3) << spec << " to " << name;
        // A texel of the other that lies around there.
        const auto at = other.parameterization.from_sphere(
            p.to_sphere(0, (x + 0.5) / size.width, (y + 0.5) / size.height));
        fill(other, kDark);
        *other.level.chart(static_cast<int>(at.chart))
             .at(static_cast<int>(at.u * other.width()), static_cast<int>(at.v * other.height())) = kLight;
        fill_borders(other);
        resample(other, window, options);
        EXPECT_NEAR(light_of(window) / light_of(other), 1, name[0] == 'o' ? 1.2e-2 : 3e-3)
            << name << " to " << spec;
      }
    }
  }
}

/// Texels that aren't square, as what was asked is believed: twice as high as wide, and very wide.
TEST(ResampleEnergyTest, TexelsThatAreNotSquareKeepTheirLight) {
  for (const char* from : {"latlong", "sky-latlong", "equal-area", "mercator", "octahedral"}) {
    for (const ChartSize size : {ChartSize{48, 48}, {96, 24}}) {
      const auto p = sphere::AnyParameterization::make(from);
      Map source(p, size.width, size.height, 1);
      for (const auto& [to, target_size] : {std::pair("latlong", 63), {"cube", 40}}) {
        Map target = make_map(to, target_size);
        ResampleOptions options = with(Filter::automatic);
        options.rotation = rotation_from_yaw_pitch_roll(31, 17, -8);
        options.fill = {kDark};
        fill(source, kDark);
        fill_borders(source);
        resample(source, target, options);
        for_each_valid_texel(target, [&](int chart, int x, int y) {
          EXPECT_NEAR(*target.level.chart(chart).at(x, y), kDark, 1e-6f * kDark);
        });
        *source.level.chart(0).at(size.width / 3, size.height / 2 + 1) = kLight;
        fill_borders(source);
        resample(source, target, options);
        EXPECT_NEAR(light_of(target) / light_of(source), 1, from[0] == 'o' ? 1.2e-2 : 3e-3)
            << from << ' ' << size.width << " to " << to;
      }
    }
  }
}

/// As exact as is promised, from maps that are not as small.
TEST(ResampleEnergyTest, OneTexelOfAFineMapKeepsItsLightWithinAThousandth) {
  for (const char* from : {"latlong", "cube"}) {
    const int size = from[0] == 'c' ? 100 : 200;
    for (const Lit& lit : some_texels(make_map(from, size))) {
      const Map source = with_light(from, size, lit.chart, lit.x, lit.y);
      for (const auto& [to, target_size] : {std::pair("latlong", 280), {"cube", 90}, {"healpix", 70}}) {
        Map target = make_map(to, target_size);
        ResampleOptions options = with(Filter::automatic);
        options.rotation = rotation_from_yaw_pitch_roll(31, 17, -8);
        resample(source, target, options);
        // The last row of a lat-long is the most bent.
        const bool pole = from[0] == 'l' && (lit.y == 0 || lit.y + 1 == source.height());
        EXPECT_NEAR(light_of(target) / light_of(source), 1, pole ? 2e-3 : 1e-3)
            << from << " to " << to << ", " << lit.chart << ' ' << lit.x << ',' << lit.y;
      }
    }
  }
}

/// A sun of half a degree, as bright as it is, and level 0 of a chain: what `convert` and `bake` do with it
/// by default.
TEST(ResampleEnergyTest, ASunKeepsItsLight) {
  const Vec3d sun = normalize(Vec3d{0.4, 0.6, 0.7});
  for (const int width : {512, 1024}) {
    Map source = make_map("latlong", 1);
    source = Map(source.parameterization, width, width / 2, 1);
    render(source,
           [&](const Vec3d& d) { return angle_between(d, sun) < 0.53 / 2 * kPi / 180 ? 60000.0 : 0.3; });
    if (light_of(source) < 1) continue;
    for (const char* name : {"cube", "octahedral", "equal-area"}) {
      const auto p = sphere::AnyParameterization::make(name);
      const ChartSize size = default_chart_size(source, p);
      Map target(p, size.width, size.height, 1);
      resample(source, target, with(Filter::automatic));
      EXPECT_NEAR(mean_over_sphere(target) / mean_over_sphere(source), 1, 1e-3) << name << ' ' << width;
    }
  }
}

/// The first row of an equal-area map is wide at the pole, and a sun there a thousandth of it.
TEST(ResampleEnergyTest, ASunAtThePoleKeepsItsLight) {
  for (const double off : {0.0, 0.004}) {
    const Vec3d sun = normalize(Vec3d{off, 1, off});
    Map source(make_map("latlong", 1).parameterization, 512, 256, 1);
    render(source, [&](const Vec3d& d) { return angle_between(d, sun) < 0.5 * kPi / 180 ? 60000.0 : 0.3; });
    for (const int size : {100, 200, 642}) {
      for (const char* name : {"equal-area", "latlong", "octahedral"}) {
        Map target = make_map(name, size);
        resample(source, target, with(Filter::automatic));
        EXPECT_NEAR(light_of(target) / light_of(source), 1, 1e-3) << name << ' ' << size << ' ' << off;
      }
    }
  }
}

/// On the rims where discs and triangles meet, and on poles and edges that pass through texels' centres: they
/// cut texels, and each part of a sun is its own picture's.
TEST(ResampleEnergyTest, ASunOnARimKeepsItsLight) {
  for (const double elevation : {90.0, 70.0, 45.0, 20.0, 0.0}) {
    const double angle = elevation * kPi / 180;
    const Vec3d sun{std::cos(angle), std::sin(angle), 0};
    Map source(make_map("latlong", 1).parameterization, 512, 256, 1);
    render(source, [&](const Vec3d& d) { return angle_between(d, sun) < 0.5 * kPi / 180 ? 60000.0 : 0.3; });
    for (const char* name : {"paraboloid", "octahedral-perspective", "mirror-ball", "angular",
                             "mitsuba-latlong", "openexr-latlong", "openexr-cube"}) {
      for (const int size : {100, 255, 256}) {
        const auto p = sphere::AnyParameterization::make(name);
        Map target(p, size, static_cast<int>(std::lround(size / p.aspect())), 1);
        resample(source, target, with(Filter::automatic));
        EXPECT_NEAR(light_of(target) / light_of(source), 1, 1e-3) << name << ' ' << size << ' ' << elevation;
        const double light = light_of(target);
        fill_borders(target, RimTexels::kept);
        EXPECT_EQ(light_of(target), light);
      }
    }
  }
}

// Of a sun in the middle of the rim of half a world: half of it, and of the rest.
TEST(ResampleEnergyTest, HalfASunOnTheRimOfHalfAWorldKeepsItsLight) {
  for (const double elevation : {90.0, 70.0, 20.0, 0.0}) {
    const double angle = elevation * kPi / 180;
    const Vec3d sun{std::cos(angle), std::sin(angle), 0};
    Map source(make_map("latlong", 1).parameterization, 512, 256, 1);
    render(source, [&](const Vec3d& d) { return angle_between(d, sun) < 0.5 * kPi / 180 ? 60000.0 : 0.3; });
    for (const char* name :
         {"fisheye-equidistant", "fisheye-equisolid", "fisheye-stereographic", "fisheye-orthographic"}) {
      for (const int size : {100, 255}) {
        Map target(sphere::AnyParameterization::make(name), size, size, 1);
        resample(source, target, with(Filter::automatic));
        EXPECT_NEAR(2 * light_of(target) / light_of(source), 1, 1e-3)
            << name << ' ' << size << ' ' << elevation;
      }
    }
  }
}

}  // namespace
}  // namespace welkin
