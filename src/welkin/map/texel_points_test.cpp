#include "welkin/map/texel_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "welkin/map/map_cases.h"

namespace welkin {
namespace {

using sphere::AnyParameterization;

double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

double sum(const std::vector<TexelPoint>& points) {
  double total = 0;
  for (const TexelPoint& point : points) total += point.solid_angle;
  return total;
}

/// Every parameterization, odd sizes and coarse ones: what all texels cover is the coverage. The density of
/// an orthographic fisheye is infinite on its rim. Edge-centred maps of one texel have no inside.
TEST(TexelPoints, TexelsCoverTheMap) {
  for (const std::string& name : cases::names_and_windows()) {
    for (const int side : {1, 2, 9, 32}) {
      if (name.starts_with("openexr") && side < 9) continue;
      const Map map = cases::make_map(name, side);
      const AnyParameterization& p = map.parameterization;
      double total = 0;
      for (int chart = 0; chart < map.charts(); ++chart) {
        for (int y = 0; y < map.height(); ++y) {
          total += sum(summed_solid_angles(p, {map.width(), map.height()}, chart, y));
        }
      }
      double bound = side < 4 ? 1e-4 : 5e-6;
      if (!p.full_charts()) bound = side < 4 ? 1e-2 : 3e-5;
      if (name == "fisheye-orthographic") bound = side < 4 ? 1e-2 : 1e-3;
      EXPECT_NEAR(total / p.coverage(), 1, bound) << name << ' ' << side;
    }
  }
}

TEST(TexelPoints, SolidAnglesInFloatAreThose) {
  for (const std::string& name : cases::names_and_windows()) {
    for (const int side : {9, 32}) {
      const Map map = cases::make_map(name, side);
      const ChartSize size{map.width(), map.height()};
      std::vector<float> row(static_cast<std::size_t>(map.width()));
      for (int chart = 0; chart < map.charts(); ++chart) {
        for (int y = 0; y < map.height(); ++y) {
          texel_solid_angles(map.parameterization, size.width, size.height, chart, y, row.data());
          const std::vector<double> expected = summed_solid_angles(map.parameterization, size, chart, y);
          for (int x = 0; x < size.width; ++x) {
            const std::size_t i = static_cast<std::size_t>(x);
            EXPECT_NEAR(row[i], expected[i], (side < 32 ? 1e-3 : 1e-4) * expected[i] + 1e-9)
                << name << ' ' << side << ' ' << chart << ' ' << y << ' ' << x;
          }
        }
      }
    }
  }
}

/// A quarter of a disc of radius ½ within a cell, and what a rim leaves of a cell that it crosses.
TEST(TexelPoints, RimsAreFollowed) {
  const auto p = AnyParameterization::make("fisheye-equisolid");
  const double density = p.solid_angle_density(0, 0.5, 0.5);  // everywhere the same
  struct Case {
    ChartCell cell;
    double area;
  };
  const double quarter = kPi / 16;
  for (const Case& each : {Case{{0, 0, 0, 0.5, 0.5}, quarter}, Case{{0, 0.5, 0, 0.5, 0.5}, quarter},
                           Case{{0, 0, 0, 1, 1}, 4 * quarter}, Case{{0, 0, 0, 1, 0.5}, 2 * quarter}}) {
    std::vector<TexelPoint> points;
    append_points(p, each.cell, {1e-6}, points);
    EXPECT_NEAR(sum(points) / density / each.area, 1, 1e-3) << each.cell.u << ' ' << each.cell.width;
    for (const TexelPoint& point : points) {
      const auto position = p.from_sphere(point.direction);
      EXPECT_TRUE(p.valid(0, position.u, position.v));
    }
  }
}

/// By ten thousand points: a texel that a diagonal of the octahedron halves.
TEST(TexelPoints, KinksAreResolved) {
  const auto p = AnyParameterization::make("octahedral");
  const ChartSize size{33, 33};
  for (const int x : {16, 10, 4}) {
    const ChartCell texel = texel_cell(size, 0, x, 16);
    double fine = 0;
    for (int i = 0; i < 10000; ++i) {
      fine += p.solid_angle_density(0, texel.u + (i % 100 + 0.5) / 100 * texel.width,
                                    texel.v + (i / 100 + 0.5) / 100 * texel.height) *
              texel.width * texel.height / 10000;
    }
    std::vector<TexelPoint> points;
    append_points(p, texel, texel_limits(p, size), points);
    EXPECT_NEAR(sum(points) / fine, 1, 2e-5) << x;
  }
}

/// The texel at the rim of a mirror ball reaches far along a meridian: no gap in its points, and few of them.
TEST(TexelPoints, SidesAreCutToTheLimit) {
  const auto p = AnyParameterization::make("mirror-ball");
  const ChartCell texel = texel_cell({64, 64}, 0, 32, 0);
  CellLimits limits = texel_limits(p, {64, 64});
  limits.side = 0.02;
  std::vector<TexelPoint> points;
  append_points(p, texel, limits, points);
  std::vector<double> angles;
  for (const TexelPoint& point : points) angles.push_back(std::acos(point.direction.z));
  std::sort(angles.begin(), angles.end());
  const auto [nearest, farthest] = std::pair(angles.front(), angles.back());
  EXPECT_GT(farthest - nearest, 0.3);
  for (std::size_t i = 1; i < angles.size(); ++i) EXPECT_LT(angles[i] - angles[i - 1], 0.02);
  EXPECT_LT(points.size(), 20000u);
}

TEST(TexelPoints, KindsOfTexels) {
  const auto count = [](const std::vector<TexelKind>& kinds, TexelKind kind) {
    return std::count(kinds.begin(), kinds.end(), kind);
  };
  const auto disc = AnyParameterization::make("fisheye-equisolid");
  const std::vector<TexelKind> top = texel_kinds(disc, {64, 64}, 0, 3);
  EXPECT_EQ(top[0], TexelKind::outside);
  EXPECT_EQ(top[32], TexelKind::plain);
  // The rim is at x = 0.5 − √(0.25 − (0.5 − y/64)²): from 18.5 to 16.5 down the row.
  for (int x = 0; x < 64; ++x) {
    const bool cut = (x >= 16 && x <= 18) || (x >= 45 && x <= 47);
    if (cut) continue;
    EXPECT_NE(top[static_cast<std::size_t>(x)], TexelKind::irregular) << x;
  }
  EXPECT_GE(count(top, TexelKind::irregular), 4);
  for (const char* smooth : {"latlong", "cube", "equal-area"}) {
    const Map map = cases::make_map(smooth, 64);
    EXPECT_EQ(count(texel_kinds(map.parameterization, {map.width(), map.height()}, 0, 20), TexelKind::plain),
              map.width())
        << smooth;
  }
  const auto octahedron = AnyParameterization::make("octahedral");
  const std::vector<TexelKind> kinked = texel_kinds(octahedron, {65, 65}, 0, 10);
  EXPECT_EQ(kinked[32], TexelKind::irregular);
  EXPECT_LE(count(kinked, TexelKind::irregular), 9);
}

}  // namespace
}  // namespace welkin
