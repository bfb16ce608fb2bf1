#include "welkin/lookup/summed_area.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "welkin/lookup/chart_unfolding.h"
#include "welkin/map/map_cases.h"

namespace welkin::test {
namespace {

/// Radiances of twelve orders of magnitude, some negative.
Map wild_map(const std::string& spec, int size) {
  Map map = cases::make_map(spec, size, 2);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> power(-6, 6);
  for (int chart = 0; chart < map.charts(); ++chart) {
    for (int y = 0; y < map.height(); ++y) {
      for (int x = 0; x < map.width(); ++x) {
        map.level.chart(chart).at(x, y)[0] = static_cast<float>(std::pow(10, power(random)));
        map.level.chart(chart).at(x, y)[1] = static_cast<float>(power(random));
      }
    }
  }
  return map;
}

TEST(SummedArea, IsOffByHalfAUnitForEachTexelAtMost) {
  const Map map = wild_map("latlong", 200);
  const SummedArea table(map);
  std::vector<float> solid_angles(static_cast<std::size_t>(map.width()));
  std::mt19937 random(5);
  std::uniform_int_distribution<int> column(0, map.width()), row(0, map.height());
  for (int k = 0; k < 300; ++k) {
    int left = column(random), right = column(random), top = row(random), bottom = row(random);
    if (left > right) std::swap(left, right);
    if (top > bottom) std::swap(top, bottom);
    if (left == right || top == bottom) continue;
    long double want[3] = {};
    for (int y = top; y < bottom; ++y) {
      texel_solid_angles(map.parameterization, map.width(), map.height(), 0, y, solid_angles.data());
      for (int x = left; x < right; ++x) {
        const auto solid_angle = static_cast<long double>(solid_angles[static_cast<std::size_t>(x)]);
        const float* texel = map.level.chart(0).at(x, y);
        want[0] += solid_angle * static_cast<long double>(texel[0]);
        want[1] += solid_angle * static_cast<long double>(texel[1]);
        want[2] += solid_angle;
      }
    }
    double got[3] = {};
    table.add({0, static_cast<double>(left), static_cast<double>(top), static_cast<double>(right),
               static_cast<double>(bottom)},
              1, got);
    const double texels = static_cast<double>(right - left) * (bottom - top);
    for (int c = 0; c < 3; ++c) {
      // And the rounding of the products, and of a result in double.
      const double bound = 0.5 * texels * table.unit(c) + 1e-15 * std::fabs(static_cast<double>(want[c])) +
                           texels * 1.2e-16 * 1e-4;
      EXPECT_LE(std::fabs(got[c] - static_cast<double>(want[c])), bound) << c << " of " << texels;
    }
  }
}

TEST(SummedArea, CountsATexelThatIsCutByThePartOfItsArea) {
  const Map map = wild_map("cube", 16);
  const SummedArea table(map);
  double whole[3] = {}, parts[3] = {}, quarter[3] = {};
  table.add({3, 2, 5, 9, 11}, 1, whole);
  table.add({3, 2, 5, 4.25, 11}, 1, parts);
  table.add({3, 4.25, 5, 9, 7.75}, 1, parts);
  table.add({3, 4.25, 7.75, 9, 11}, 1, parts);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(parts[c] / whole[c], 1, 1e-12);
  double texel[3] = {};
  table.add({3, 2, 5, 3, 6}, 1, texel);
  table.add({3, 2.5, 5.25, 3, 5.75}, 1, quarter);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(quarter[c] / texel[c], 0.25, 1e-12);
}

TEST(SummedArea, OfAWholeMapIsItsEnergy) {
  const Map map = cases::rendered("octahedral", 64, cases::smooth);
  const SummedArea table(map);
  double sums[2] = {};
  table.add({0, 0, 0, 64, 64}, 1, sums);
  EXPECT_NEAR(sums[1] / (4 * kPi), 1, 1e-4);
  EXPECT_NEAR(sums[0] / sums[1], cases::mean_over_sphere(map), 1e-5);
}

/// The solid angle of a rectangle's parts, and the mean over them.
struct Covered {
  double solid_angle, mean;
};
Covered covered(const Map& map, const ChartRectangle& r) {
  const SummedArea table(map);
  const ChartUnfolding unfolding(map.parameterization, {map.width(), map.height()});
  double sums[2] = {};
  const auto parts = unfolding.parts_of(r);
  for (int i = 0; i < parts.count; ++i) table.add(parts.list[i], 1, sums);
  return {sums[1], sums[0] / sums[1]};
}

/// The mean of a function over the directions of a rectangle in a chart's extended domain.
double extended_mean(const Map& map, const ChartRectangle& r, const cases::Function& f) {
  const auto& p = map.parameterization;
  constexpr int kPoints = 40;
  double sum = 0, total = 0;
  for (int k = 0; k < kPoints * kPoints; ++k) {
    const double x = r.left + (k % kPoints + 0.5) / kPoints * (r.right - r.left);
    const double y = r.top + (k / kPoints + 0.5) / kPoints * (r.bottom - r.top);
    const Vec3d d = p.to_sphere(r.chart, x / map.width(), y / map.height());
    const auto at = p.from_sphere(d);
    const double density = p.solid_angle_density(static_cast<int>(at.chart), at.u, at.v);
    sum += density * f(d);
    total += density;
  }
  return sum / total;
}

TEST(ChartUnfolding, GoesOnWhereTheChartsExtendedDomainDoes) {
  // A lat-long and octahedra exactly, but for steps between texels. A cube's sides go on texel by texel, and
  // not in perspective: a twenty-fifth of a side past an edge that is within 2.5°, of a slope of 1.4.
  const auto slope = [](const Vec3d& d) { return 3 + d.x + 0.6 * d.y - 0.8 * d.z; };
  for (const std::string spec : {"latlong", "octahedral", "octahedral-equal-area", "cube", "eac"}) {
    const Map map = cases::rendered(spec, 64, slope);
    const double w = map.width(), h = map.height(), half = 2;
    for (int chart = 0; chart < map.charts(); ++chart) {
      for (const double along : {0.2, 0.4, 0.75}) {
        for (const auto& [u, v] : {std::pair{-0.04, along}, {1.04, along}, {along, -0.04}, {along, 1.04}}) {
          const ChartRectangle r{chart, u * w - half, v * h - half, u * w + half, v * h + half};
          EXPECT_NEAR(covered(map, r).mean, extended_mean(map, r, slope), map.charts() > 1 ? 0.06 : 3e-3)
              << spec << " chart " << chart << " at " << u << " " << v;
        }
      }
    }
  }
}

TEST(ChartUnfolding, LosesNothingOfALatLongAndAnOctahedron) {
  // All around a lat-long, across the date line; and a square of an octahedron over a corner: four of the
  // like are the four quarters about −Y.
  const Map latlong = cases::rendered("latlong", 32, cases::smooth);
  const double w = latlong.width(), h = latlong.height();
  EXPECT_NEAR(covered(latlong, {0, 0.9 * w, 0, 1.9 * w, h}).solid_angle, 4 * kPi, 1e-3);
  const Covered cap = covered(latlong, {0, 3, -4, 3 + w / 2, 4});
  EXPECT_NEAR(cap.solid_angle, 2 * kPi * (1 - std::cos(kPi * 4 / h)), 1e-4)
      << "half of it twice, by two sides";
  const Map octahedral = cases::rendered("octahedral", 32, cases::smooth);
  const Covered corner = covered(octahedral, {0, -3, -3, 3, 3});
  double sums[2] = {};
  SummedArea(octahedral).add({0, 0, 0, 3, 3}, 4, sums);
  EXPECT_NEAR(corner.solid_angle, sums[1], 1e-6);
}

}  // namespace
}  // namespace welkin::test
