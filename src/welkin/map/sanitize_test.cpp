#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "welkin/map/adjust.h"
#include "welkin/map/map_cases.h"

namespace welkin {
namespace {

using cases::for_each_valid_texel;
using sphere::AnyParameterization;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

void fill(Map& map, float value) {
  for (int chart = 0; chart < map.charts(); ++chart) {
    for (int y = 0; y < map.height(); ++y) {
      std::fill_n(map.level.chart(chart).row(y), map.width() * map.channels(), value);
    }
  }
  fill_borders(map);
}

Map constant_map(const std::string& spec, int width, int height, int channels, float value) {
  Map map(AnyParameterization::make(spec), width, height, channels);
  fill(map, value);
  return map;
}

/// `value` within `radius` radians of the direction.
void paint(Map& map, const Vec3d& direction, double radius, float value) {
  for_each_valid_texel(map, [&](int chart, int x, int y) {
    if (dot(cases::direction_at(map, chart, x, y), normalize(direction)) < std::cos(radius)) return;
    std::fill_n(map.level.chart(chart).at(x, y), map.channels(), value);
  });
}

TEST(Sanitize, ReplacesByTheMeanOfNeighboursAsTheyWere) {
  Map map(AnyParameterization::make("latlong"), 8, 6, 2);
  const ImageView<float> chart = map.level.chart(0);
  for (int y = 0; y < 6; ++y) {
    for (int x = 0; x < 8; ++x) {
      chart.at(x, y)[0] = static_cast<float>(x);
      chart.at(x, y)[1] = static_cast<float>(10 * y);
    }
  }
  // A pair one under the other: neither may be filled from the other's replacement.
  chart.at(3, 2)[0] = kNan;
  chart.at(3, 3)[0] = kInfinity;
  chart.at(4, 3)[0] = 100;
  // In the other channel, at the date line.
  chart.at(0, 2)[1] = -kInfinity;
  EXPECT_EQ(sanitize(map).filled, 3u);
  EXPECT_FLOAT_EQ(chart.at(3, 2)[0], (2 + 3 + 4 + 2 + 4 + 2 + 100) / 7.0f);
  EXPECT_FLOAT_EQ(chart.at(3, 3)[0], (2 + 4 + 2 + 100 + 2 + 3 + 4) / 7.0f);
  EXPECT_EQ(chart.at(3, 2)[1], 20);
  EXPECT_FLOAT_EQ(chart.at(0, 2)[1], (3 * 10 + 2 * 20 + 3 * 30) / 8.0f);
  EXPECT_EQ(sanitize(map).filled, 0u);
}

TEST(Sanitize, ChartsWithoutAnyFiniteValueGetTheReplacement) {
  Map map = constant_map("cube", 4, 4, 2, 1);
  for (int chart = 0; chart < 5; ++chart) {
    for (int y = 0; y < 4; ++y) {
      for (int x = 0; x < 4; ++x) map.level.chart(chart).at(x, y)[0] = kNan;
    }
  }
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) map.level.chart(5).at(x, y)[0] = x + y == 0 ? 2 : kInfinity;
  }
  EXPECT_EQ(sanitize(map, {.replacement = 7}).filled, 6u * 16u - 1);
  EXPECT_EQ(map.level.chart(0).at(2, 2)[0], 7);
  EXPECT_EQ(map.level.chart(4).at(0, 3)[0], 7);
  // What is left of a chart fills all of it.
  EXPECT_EQ(map.level.chart(5).at(1, 1)[0], 2);
  EXPECT_EQ(map.level.chart(5).at(3, 3)[0], 2);
  EXPECT_EQ(map.level.chart(3).at(1, 3)[1], 1);
}

TEST(Sanitize, AHoleOfAnySizeBecomesTheSkyAroundIt) {
  for (const char* spec : {"latlong", "cube", "octahedral", "healpix", "angular", "half-cube"}) {
    for (const Vec3d& where : {Vec3d{0.3, 0.5, 0.9}, Vec3d{0, 0, 1}, Vec3d{0.02, 1, 0.03}, Vec3d{1, 1, 1}}) {
      for (const double radius : {0.03, 0.3, 1.2}) {
        Map map = cases::make_map(spec, 64, 3);
        fill(map, 0.5f);
        paint(map, where, radius, kInfinity);
        std::uint64_t infinite = 0;
        for_each_valid_texel(map, [&](int chart, int x, int y) {
          infinite += std::isinf(map.level.chart(chart).at(x, y)[0]) ? 1 : 0;
        });
        // Whole faces of a cube get the replacement, unless it is the sky's.
        EXPECT_EQ(sanitize(map, {.replacement = 0.5f}).filled, infinite) << spec;
        for_each_valid_texel(map, [&](int chart, int x, int y) {
          for (int c = 0; c < 3; ++c) EXPECT_EQ(map.level.chart(chart).at(x, y)[c], 0.5f) << spec;
        });
        EXPECT_EQ(*map.level.chart(0).at(-1, 3), 0.5f) << spec << ": a border";
      }
    }
  }
}

TEST(Sanitize, NeighboursAreThoseOnTheSphere) {
  // Across the date line.
  Map map(AnyParameterization::make("latlong"), 16, 8, 1);
  fill(map, 3);
  for (int y = 0; y < 8; ++y) *map.level.chart(0).at(15, y) = 1;
  *map.level.chart(0).at(0, 4) = kNan;
  // Across the pole: half a turn away.
  *map.level.chart(0).at(3, 0) = kNan;
  for (const int x : {10, 11, 12}) *map.level.chart(0).at(x, 0) = 11;
  sanitize(map);
  EXPECT_EQ(*map.level.chart(0).at(0, 4), (3 * 1 + 5 * 3) / 8.0f);
  EXPECT_EQ(*map.level.chart(0).at(3, 0), (5 * 3 + 3 * 11) / 8.0f);

  // Across a cube's edge, in its middle, where the face's own texels are the others.
  Map cube(AnyParameterization::make("cube"), 8, 8, 1);
  for (int chart = 0; chart < 6; ++chart) {
    for (int y = 0; y < 8; ++y) std::fill_n(cube.level.chart(chart).row(y), 8, chart == 4 ? 1.0f : 9.0f);
  }
  *cube.level.chart(4).at(0, 4) = kInfinity;
  sanitize(cube);
  EXPECT_EQ(*cube.level.chart(4).at(0, 4), (5 * 1 + 3 * 9) / 8.0f);
}

TEST(Sanitize, TheFillIsSmoothAndWithinTheRangeOfItsRim) {
  for (const char* spec : {"latlong", "cube", "octahedral"}) {
    const auto gradient = [](const Vec3d& d) { return 2 + d.x; };
    Map map = cases::rendered(spec, 96, gradient);
    paint(map, {0, 0.2, 1}, 0.35, kNan);
    sanitize(map);
    double largest = 0;
    for_each_valid_texel(map, [&](int chart, int x, int y) {
      const Vec3d d = cases::direction_at(map, chart, x, y);
      largest =
          std::max(largest, std::fabs(static_cast<double>(*map.level.chart(chart).at(x, y)) - gradient(d)));
    });
    // The gradient's range across the hole is 2 sin 0.35 = 0.69; rings alone are off by 0.2 of it.
    EXPECT_LT(largest, 0.15) << spec;
  }
}

TEST(Sanitize, WhatLiesOutsideADiscFillsNothingInside) {
  Map map = cases::rendered("angular", 32, [](const Vec3d&) { return 4; });
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 32; ++x) {
      if (!cases::is_valid_texel(map, 0, x, y)) *map.level.chart(0).at(x, y) = x < 16 ? 100.0f : kNan;
    }
  }
  // At the rim.
  *map.level.chart(0).at(0, 15) = kNan;
  *map.level.chart(0).at(4, 5) = kNan;
  EXPECT_GT(sanitize(map).filled, 100u);
  EXPECT_EQ(*map.level.chart(0).at(0, 15), 4);
  EXPECT_EQ(*map.level.chart(0).at(4, 5), 4);
  EXPECT_EQ(*map.level.chart(0).at(31, 0), 4);
}

TEST(Sanitize, ThreadsChangeNothing) {
  const auto repaired = [](int threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
    Map map = cases::rendered(
        "cube", 200, [](const Vec3d& d) { return 2 + d.x * d.y + d.z; }, 2);
    paint(map, {1, 0.9, 0.4}, 0.9, kInfinity);
    paint(map, {-1, 0.1, 0.4}, 0.1, kNan);
    sanitize(map);
    return map;
  };
  const Map one = repaired(1), four = repaired(4);
  for_each_valid_texel(one, [&](int chart, int x, int y) {
    for (int c = 0; c < 2; ++c) {
      ASSERT_TRUE(std::isfinite(one.level.chart(chart).at(x, y)[c]));
      ASSERT_EQ(one.level.chart(chart).at(x, y)[c], four.level.chart(chart).at(x, y)[c]);
    }
  });
}

TEST(Sanitize, InfiniteValuesBecomeALargeOne) {
  const auto wild = [] {
    Map map = constant_map("latlong", 16, 8, 4, 0.5f);
    float* texel = map.level.chart(0).at(5, 4);
    texel[0] = kInfinity;
    texel[1] = -kInfinity;
    texel[2] = kNan;
    texel[3] = kInfinity;  // A
    return map;
  };
  Map map = wild();
  SanitizeReport report = sanitize(map, {.infinite = 65504.0f});
  EXPECT_EQ(report.infinite, 2u);
  EXPECT_EQ(report.filled, 1u);
  EXPECT_EQ(report.clamped, 0u);
  const float* texel = map.level.chart(0).at(5, 4);
  EXPECT_EQ(texel[0], 65504);
  EXPECT_EQ(texel[1], -65504);
  EXPECT_EQ(texel[2], 0.5f);
  EXPECT_EQ(texel[3], 0.5f);

  map = wild();
  report = sanitize(map, {.infinite = 100.0f, .negative_infinite = false});
  EXPECT_EQ(map.level.chart(0).at(5, 4)[0], 100);
  EXPECT_EQ(map.level.chart(0).at(5, 4)[1], 0);
}

TEST(Sanitize, ClampsAfterwards) {
  Map map = constant_map("latlong", 16, 8, 4, 0.5f);
  float* texel = map.level.chart(0).at(5, 4);
  texel[0] = 1e9f;
  texel[1] = -3;
  texel[2] = kNan;
  texel[3] = 9;
  map.level.chart(0).at(6, 4)[0] = kInfinity;
  const SanitizeReport report = sanitize(map, {.fill = false, .minimum = 0, .maximum = 1000});
  EXPECT_EQ(report.clamped, 3u);
  EXPECT_EQ(report.filled, 0u);
  EXPECT_EQ(texel[0], 1000);
  EXPECT_EQ(texel[1], 0);
  EXPECT_TRUE(std::isnan(texel[2]));
  EXPECT_EQ(texel[3], 9) << "A is no radiance";
  EXPECT_EQ(map.level.chart(0).at(6, 4)[0], 1000);
}

TEST(Sanitize, OptionsAreChecked) {
  Map map = constant_map("latlong", 16, 8, 1, 1);
  for (const SanitizeOptions& options :
       {SanitizeOptions{.replacement = kNan}, SanitizeOptions{.infinite = -1.0f},
        SanitizeOptions{.infinite = kInfinity}, SanitizeOptions{.minimum = 2, .maximum = 1},
        SanitizeOptions{.minimum = kNan}}) {
    EXPECT_THROW(sanitize(map, options), Error);
  }
}

}  // namespace
}  // namespace welkin
