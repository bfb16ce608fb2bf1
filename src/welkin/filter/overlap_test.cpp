#include "welkin/filter/overlap.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <random>
#include <utility>

#include "welkin/filter/outline.h"
#include "welkin/map/map_cases.h"

namespace welkin {
namespace {

using namespace cases;
using Polygon = std::vector<OutlinePoint>;
using Moments = std::map<std::pair<int, int>, OverlapMoments>;

Moments moments_of(const Polygon& polygon, int x, int y, int width, int height,
                   const std::vector<float>* bend = nullptr) {
  PolygonOverlap overlap(bend);
  overlap.start(x, y, width, height);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const OutlinePoint &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    overlap.add_edge(a.x, a.y, b.x, b.y);
  }
  Moments all;
  overlap.for_each([&](int column, int row, int count, const OverlapMoments& m) {
    for (int i = 0; i < count; ++i) all[{column + i, row}] = m;
  });
  return all;
}

bool is_inside(const Polygon& polygon, double x, double y) {
  bool inside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const OutlinePoint &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    if ((a.y > y) != (b.y > y) && x < a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
  }
  return inside;
}

/// Against sums over 200×200 points of every texel.
TEST(OverlapTest, MomentsAreThoseOfThePolygon) {
  const Polygon polygon = {{2.3, 1.2}, {5.9, 2.4}, {6.1, 2.4}, {4.4, 6.7}, {3.0, 4.0}, {1.1, 5.5}};
  const Moments exact = moments_of(polygon, 0, 0, 8, 8);
  constexpr int kPoints = 200;
  for (int row = 0; row < 8; ++row) {
    for (int column = 0; column < 8; ++column) {
      OverlapMoments m{};
      for (int i = 0; i < kPoints * kPoints; ++i) {
        const double x = (i % kPoints + 0.5) / kPoints - 0.5, y = (i / kPoints + 0.5) / kPoints - 0.5;
        if (!is_inside(polygon, column + 0.5 + x, row + 0.5 + y)) continue;
        m.area += 1;
        m.x += x;
        m.y += y;
        m.xx += x * x - 1.0 / 12;
        m.xy += x * y;
        m.yy += y * y - 1.0 / 12;
      }
      const auto found = exact.find({column, row});
      const OverlapMoments got = found == exact.end() ? OverlapMoments{} : found->second;
      const double scale = 1.0 / (kPoints * kPoints), sign = -1;  // clockwise, as pictures go down
      EXPECT_NEAR(sign * got.area, m.area * scale, 2e-3) << column << ' ' << row;
      EXPECT_NEAR(sign * got.x, m.x * scale, 2e-3) << column << ' ' << row;
      EXPECT_NEAR(sign * got.y, m.y * scale, 2e-3) << column << ' ' << row;
      EXPECT_NEAR(sign * got.xx, m.xx * scale, 2e-3) << column << ' ' << row;
      EXPECT_NEAR(sign * got.xy, m.xy * scale, 2e-3) << column << ' ' << row;
      EXPECT_NEAR(sign * got.yy, m.yy * scale, 2e-3) << column << ' ' << row;
    }
  }
}

/// Quadrilaterals that tile a square share out every texel, moments and all, to rounding.
TEST(OverlapTest, PolygonsThatShareEdgesDivideTexelsExactly) {
  constexpr int kParts = 7, kTexels = 5;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> jitter(-0.2, 0.2);
  std::array<std::array<OutlinePoint, kParts + 1>, kParts + 1> corners;
  for (int j = 0; j <= kParts; ++j) {
    for (int i = 0; i <= kParts; ++i) {
      const double step = static_cast<double>(kTexels) / kParts;
      const double x = i == 0 || i == kParts ? 0 : jitter(random),
                   y = j == 0 || j == kParts ? 0 : jitter(random);
      corners[static_cast<std::size_t>(j)][static_cast<std::size_t>(i)] = {(i + x) * step, (j + y) * step};
    }
  }
  const std::vector<float> bend = {1.0f, 0.3f, 0.0f, -0.3f, -1.0f};
  for (const std::vector<float>* stretched : {static_cast<const std::vector<float>*>(nullptr), &bend}) {
    Moments sum;
    for (std::size_t j = 0; j < kParts; ++j) {
      for (std::size_t i = 0; i < kParts; ++i) {
        const Polygon polygon = {corners[j][i], corners[j][i + 1], corners[j + 1][i + 1], corners[j + 1][i]};
        for (const auto& [texel, m] : moments_of(polygon, 0, 0, kTexels, kTexels, stretched)) {
          OverlapMoments& all = sum[texel];
          all.area += m.area;
          all.x += m.x;
          all.y += m.y;
          all.xx += m.xx;
          all.xy += m.xy;
          all.yy += m.yy;
        }
      }
    }
    ASSERT_EQ(sum.size(), static_cast<std::size_t>(kTexels * kTexels));
    for (const auto& [texel, m] : sum) {
      EXPECT_NEAR(m.area, -1, 1e-12);
      for (const double each : {m.x, m.y, m.xx, m.xy, m.yy}) EXPECT_NEAR(each, 0, 1e-12);
    }
  }
}

/// The outlines of all of a target's texels cover a source's charts once.
TEST(OutlineTest, OutlinesCoverTheSourceOnce) {
  for (const char* from : {"latlong", "cube", "octahedral", "healpix", "equal-area"}) {
    for (const char* to : {"latlong", "cube", "octahedral", "healpix", "octahedral-rect"}) {
      for (const bool turned : {false, true}) {
        const Map source = make_map(from, 12), target = make_map(to, 15);
        const Matrix3 rotation = turned ? rotation_from_yaw_pitch_roll(31, 17, -8) : Matrix3{};
        const MapFrame frame(target);
        const Outline outline(source.parameterization, {source.width(), source.height()}, frame, rotation);
        std::map<std::array<int, 3>, double> areas;
        std::vector<OutlineLoop> loops;
        for (int chart = 0; chart < target.charts(); ++chart) {
          for (int y = 0; y < target.height(); ++y) {
            for (int x = 0; x < target.width(); ++x) {
              ASSERT_TRUE(outline.trace(chart, x, y, loops)) << from << ' ' << to << ' ' << x << ' ' << y;
              for (const OutlineLoop& loop : loops) {
                for (const auto& [texel, m] : moments_of(loop.points, 0, 0, source.width(), source.height()))
                  areas[{loop.chart, texel.first, texel.second}] += std::fabs(m.area);
              }
            }
          }
        }
        for (int chart = 0; chart < source.charts(); ++chart) {
          for (int y = 0; y < source.height(); ++y) {
            for (int x = 0; x < source.width(); ++x) {
              EXPECT_NEAR((areas[{chart, x, y}]), 1, 6e-3)
                  << from << ' ' << to << (turned ? " turned " : " ") << chart << ' ' << x << ',' << y;
            }
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace welkin
