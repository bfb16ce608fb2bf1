#include "welkin/harmonics/project.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <limits>
#include <random>

#include "welkin/base/error.h"
#include "welkin/harmonics/harmonics_cases.h"
#include "welkin/map/map_cases.h"
#include "welkin/map/texel_points.h"
#include "welkin/math/gauss_legendre.h"

namespace welkin::harmonics {
namespace {

using cases::random_harmonics;
using cases::relative_error;
using welkin::cases::make_map;
using welkin::cases::names_and_windows;
using welkin::cases::test_name;

/// Random texels, some of them a thousand times as bright.
Map random_map(const std::string& spec, int size, int channels = 1) {
  Map map = make_map(spec, size, channels);
  std::mt19937 random(7);
  std::uniform_real_distribution<float> uniform(0, 1);
  for (int chart = 0; chart < map.charts(); ++chart) {
    ImageView<float> view = map.level.chart(chart);
    for (int y = 0; y < map.height(); ++y) {
      for (int i = 0; i < map.width() * channels; ++i)
        view.row(y)[i] = uniform(random) * (uniform(random) > 0.98f ? 1000.0f : 1.0f);
    }
  }
  map.orientation = rotation_from_yaw_pitch_roll(20, 35, -50);
  fill_borders(map);
  return map;
}

/// The definition: each texel in cells × cells parts of 3×3 points, those that are valid.
SphericalHarmonics brute_force(const Map& map, int degree, int cells) {
  static const QuadratureRule rule = gauss_legendre(3);
  SphericalHarmonics result(degree, 1);
  std::vector<double> functions(static_cast<std::size_t>(result.count()));
  const auto& p = map.parameterization;
  for (int chart = 0; chart < map.charts(); ++chart) {
    for (int y = 0; y < map.height(); ++y) {
      for (int x = 0; x < map.width(); ++x) {
        const ChartCell texel = texel_cell({map.width(), map.height()}, chart, x, y);
        const double value = static_cast<double>(map.level.chart(chart).row(y)[x]);
        for (int k = 0; k < 9 * cells * cells; ++k) {
          const ChartCell part = texel.part(k / 9 % cells, cells, k / 9 / cells, cells);
          const std::size_t i = static_cast<std::size_t>(k % 3), j = static_cast<std::size_t>(k / 3 % 3);
          const double u = part.u + part.width * (0.5 + 0.5 * rule.nodes[i]),
                       v = part.v + part.height * (0.5 + 0.5 * rule.nodes[j]);
          if (!p.valid(chart, u, v)) continue;
          const double weight = value * p.solid_angle_density(chart, u, v) * part.width * part.height *
                                rule.weights[i] * rule.weights[j] / 4;
          evaluate_functions(degree, transpose(map.orientation) * p.to_sphere(chart, u, v), functions);
          for (std::size_t f = 0; f < functions.size(); ++f) result.values()[f] += weight * functions[f];
        }
      }
    }
  }
  return result;
}

class EveryProjection : public ::testing::TestWithParam<std::string> {};

TEST_P(EveryProjection, IsThatOfTheTexelsByBruteForce) {
  const Map map = random_map(GetParam(), 16);
  const SphericalHarmonics found = project(map, 4), expected = brute_force(map, 4, 6);
  // What the reference is good for: 18×18 points of a texel don't follow rims, nor creases and the poles of
  // maps of equal area as closely.
  const auto& p = map.parameterization;
  const double tolerance = !p.full_charts()                                        ? 1e-3
                           : p.density_by_row() || GetParam() == "octahedral-rect" ? 5e-5
                                                                                   : 1e-6;
  EXPECT_LT(relative_error(found, expected), GetParam() == "latlong" ? 1e-6 : tolerance);
}

TEST_P(EveryProjection, OfAConstantIsItsSolidAngle) {
  Map map = make_map(GetParam(), 40);
  for (int chart = 0; chart < map.charts(); ++chart) {
    ImageView<float> view = map.level.chart(chart);
    for (int y = 0; y < map.height(); ++y) std::fill_n(view.row(y), map.width(), 1.0f);
  }
  const SphericalHarmonics found = project(map, 5);
  const double coverage = map.parameterization.coverage();
  // Edge-centred maps count positions up to 1e-6 beyond their edges as theirs; the orthographic fisheye's
  // density ends before its rim.
  const bool full = map.parameterization.full_charts();
  const double tolerance = full ? 1e-6 : GetParam() == "fisheye-orthographic" ? 2e-4 : 6e-6;
  EXPECT_NEAR(found.at(0, 0, 0) * std::sqrt(4 * kPi) / coverage, 1, tolerance);
  if (!map.parameterization.whole_world()) return;
  for (std::size_t i = 1; i < found.values().size(); ++i)
    EXPECT_NEAR(found.values()[i], 0, tolerance * found.at(0, 0, 0)) << i;
}

INSTANTIATE_TEST_SUITE_P(Projections, EveryProjection, ::testing::ValuesIn(names_and_windows()), test_name);

TEST(Project, IsExactForHighDegreesToo) {
  for (const std::string spec : {"latlong", "cube", "eac"}) {
    const Map map = random_map(spec, 6);
    EXPECT_LT(relative_error(project(map, 16), brute_force(map, 16, 12)), 1e-6) << spec;
  }
}

TEST(Project, TakesRowsOfAnyLengthAndAnyChannels) {
  for (const int channels : {1, 2, 3, 4, 5}) {
    for (const int width : {1, 2, 7, 16}) {
      Map map(sphere::AnyParameterization::make("latlong"), width, 9, channels);
      map.channel_names = {"R", "G", "A", "Z", "W"};
      map.channel_names.resize(static_cast<std::size_t>(channels));
      ImageView<float> view = map.level.chart(0);
      for (int y = 0; y < 9; ++y) {
        for (int x = 0; x < width; ++x) {
          for (int c = 0; c < channels; ++c)
            view.row(y)[x * channels + c] = static_cast<float>((1 + c) * (1 + (x * 7 + y * 5) % 11));
        }
      }
      Map first(map.parameterization, width, 9, 1);
      for (int y = 0; y < 9; ++y) {
        for (int x = 0; x < width; ++x) first.level.chart(0).row(y)[x] = view.row(y)[x * channels];
      }
      const SphericalHarmonics found = project(map, 3), expected = brute_force(first, 3, 6);
      ASSERT_EQ(found.channels(), channels < 3 ? channels : channels - 1);
      for (int c = 0; c < found.channels(); ++c) {
        // A is left out, and each channel is a multiple of the first.
        const int factor = c < 2 ? 1 + c : 2 + c;
        for (int i = 0; i < found.count(); ++i)
          EXPECT_NEAR(found.values()[static_cast<std::size_t>(i * found.channels() + c)],
                      factor * expected.values()[static_cast<std::size_t>(i)],
                      1e-6 * factor * expected.norm())
              << channels << " channels, width " << width;
      }
    }
  }
}

TEST(Project, DoesNotDependOnTheNumberOfThreads) {
  for (const std::string spec : {"latlong", "cube"}) {
    const Map map = random_map(spec, 64, 3);
    const SphericalHarmonics many = project(map, 5);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const SphericalHarmonics alone = project(map, 5);
    for (std::size_t i = 0; i < many.values().size(); ++i) EXPECT_EQ(many.values()[i], alone.values()[i]);
  }
}

TEST(Project, RefusesValuesThatAreNotFiniteAndSaysWhere) {
  for (const std::string spec : {"latlong", "cube"}) {
    Map map(sphere::AnyParameterization::make(spec), 32, 32, 3);
    map.level.chart(0).row(5)[3 * 7 + 1] = std::numeric_limits<float>::quiet_NaN();
    map.level.chart(0).row(9)[3 * 2] = std::numeric_limits<float>::infinity();
    const std::string message = welkin::cases::refusal([&] { project(map, 2); });
    EXPECT_NE(message.find("2 of "), std::string::npos) << message;
    EXPECT_NE(message.find("column 7, row 5"), std::string::npos) << message;
    map.level.chart(0).row(5)[3 * 7 + 1] = map.level.chart(0).row(9)[3 * 2] = 1;
    for (int x = 0; x < 32; ++x) map.level.chart(0).row(3)[3 * x] = 3e38f;
    // Rows of longitudes are added up in float.
    if (spec == "latlong") {
      EXPECT_NE(welkin::cases::refusal([&] { project(map, 2); }).find("too large"), std::string::npos);
    }
    EXPECT_THROW(project(map, kMaxDegree + 1), Error);
  }
}

TEST(Project, IgnoresWhatLiesOutsideADisc) {
  Map map = random_map("sphere", 32);
  const SphericalHarmonics expected = project(map, 3);
  map.level.chart(0).row(0)[0] = std::numeric_limits<float>::quiet_NaN();
  const SphericalHarmonics found = project(map, 3);
  for (std::size_t i = 0; i < found.values().size(); ++i) EXPECT_EQ(found.values()[i], expected.values()[i]);
}

struct RoundTrip {
  const char* spec;
  int width, height, degree;
};

TEST(MapOf, GivesItsHarmonicsBack) {
  std::mt19937 random(8);
  const RoundTrip trips[] = {{"latlong", 256, 128, 32}, {"latlong", 128, 64, 32},  {"cube", 64, 64, 32},
                             {"octahedral", 48, 48, 8}, {"equal-area", 64, 64, 6}, {"healpix", 16, 16, 8},
                             {"sphere", 64, 64, 2},     {"latlong", 1024, 512, 2}, {"cube", 4, 4, 1}};
  for (const auto& [spec, width, height, degree] : trips) {
    const SphericalHarmonics wanted = random_harmonics(degree, 3, random);
    const auto p = sphere::AnyParameterization::make(spec);
    const Map map = map_of(wanted, p, {width, height}, rotation_from_yaw_pitch_roll(10, 20, 30));
    EXPECT_LT(relative_error(project(map, degree), wanted), 1e-6) << spec << " " << degree;
    // It is the function but for the correction.
    double value[3];
    wanted.evaluate(
        transpose(map.orientation) * p.to_sphere(0, (width / 2 + 0.5) / width, (height / 3 + 0.5) / height),
        value);
    EXPECT_NEAR(static_cast<double>(map.level.chart(0).row(height / 3)[3 * (width / 2)]), value[0],
                0.1 * wanted.norm());
  }
}

TEST(MapOf, TakesTheLargestDegreeThatItNames) {
  std::mt19937 random(9);
  for (const std::string spec : {"latlong", "cube", "octahedral", "healpix", "equal-area", "openexr-latlong",
                                 "sphere", "paraboloid"}) {
    const auto p = sphere::AnyParameterization::make(spec);
    const Map shape = make_map(spec, 16);
    const ChartSize size{shape.width(), shape.height()};
    const int largest = largest_degree(p, size);
    const SphericalHarmonics wanted = random_harmonics(largest, 1, random);
    EXPECT_LT(relative_error(project(map_of(wanted, p, size), largest), wanted), 1e-5)
        << spec << " " << largest;
    EXPECT_NE(welkin::cases::refusal([&] {
                map_of(SphericalHarmonics(largest + 1, 1), p, size);
              }).find("up to " + std::to_string(largest)),
              std::string::npos);
  }
}

TEST(MapOf, ShowsAPartAsItIs) {
  std::mt19937 random(10);
  const SphericalHarmonics wanted = random_harmonics(3, 1, random);
  for (const std::string spec : {"latlong,left=-40,right=100,top=60,bottom=-20", "hemi-octahedral"}) {
    const auto p = sphere::AnyParameterization::make(spec);
    const Map map = map_of(wanted, p, {64, 64});
    double value = 0;
    wanted.evaluate(p.to_sphere(0, 20.5 / 64, 30.5 / 64), {&value, 1});
    EXPECT_NEAR(static_cast<double>(map.level.chart(0).row(30)[20]), value, 1e-3 * wanted.norm()) << spec;
  }
}

}  // namespace
}  // namespace welkin::harmonics
