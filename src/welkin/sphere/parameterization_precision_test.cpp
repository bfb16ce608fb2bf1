/// Float and SIMD packs of float against double. A direction may be off by 3e-7, about five roundings, beside
/// what a rounding of (u, v) itself would move it.

#include <algorithm>

#include "welkin/sphere/parameterization_cases.h"

namespace welkin::sphere {
namespace {

using namespace cases;

constexpr double kDirectionError = 3e-7;  ///< of to_sphere
constexpr double kInputRounding = 6e-8;   ///< 2u − 1 and the like, in float
constexpr double kPositionError = 3e-7;   ///< of from_sphere, in u and v

Vec3<float> rounded(const Vec3d& d) {
  return {static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)};
}
Vec3d widened(const Vec3<float>& d) {
  return {d.x, d.y, d.z};
}

void expect_direction(const Case& p, const Position& at, const Vec3<float>& d) {
  const double allowed = kDirectionError + wobble(p, at.chart, at.u, at.v, kInputRounding);
  ASSERT_LE(distance(widened(d), p.to_sphere(at.chart, at.u, at.v)), allowed)
      << at.chart << " " << at.u << " " << at.v;
}

void expect_position(const Case& p, const Vec3<float>& d, const ChartPoint<float>& at) {
  ASSERT_TRUE(std::isfinite(at.u) && std::isfinite(at.v)) << d.x << " " << d.y << " " << d.z;
  const int chart = static_cast<int>(at.chart);
  ASSERT_TRUE(static_cast<float>(chart) == at.chart && chart >= 0 && chart < p.charts) << at.chart;
  const Vec3d exact = widened(d);
  if (!p.covers(exact)) return;
  const double u = at.u, v = at.v;
  const double allowed = kDirectionError + wobble(p, chart, u, v, kPositionError);
  ASSERT_LE(distance(p.to_sphere(chart, u, v), normalize(exact)), allowed)
      << d.x << " " << d.y << " " << d.z << " lands on " << at.chart << " " << at.u << " " << at.v;
}

void expect_density(const Case& p, const Position& at, float density) {
  const double exact = p.solid_angle_density(at.chart, at.u, at.v);
  // 5e-6: near a rim, one rounding over the square of the cosine. Where density falls to 0, a share of the
  // average.
  const double average = p.coverage / p.charts;
  ASSERT_NEAR(density, exact, 5e-6 * exact + 4e-7 * average) << at.chart << " " << at.u << " " << at.v;
}

/// Random positions, their coordinates rounded to float.
std::vector<Position> float_positions(const Case& p, double low, double high) {
  std::vector<Position> positions = random_positions(p.charts, 16384, low, high);
  for (Position& at : positions) at = {at.chart, static_cast<float>(at.u), static_cast<float>(at.v)};
  return positions;
}

/// The same of one chart, so that a pack can be filled.
std::vector<Position> float_positions_of(const Case& p, int chart, double low, double high) {
  std::vector<Position> positions = float_positions(p, low, high);
  for (Position& at : positions) at.chart = chart;
  positions.resize(positions.size() / Pack::size / static_cast<std::size_t>(p.charts) * Pack::size);
  return positions;
}

TEST(ParameterizationPrecision, FloatDirectionsAgreeWithDouble) {
  for_all([](const Case& p) {
    for (const Position& at : float_positions(p, 0, 1)) {
      if (!p.valid(at.chart, at.u, at.v)) continue;
      expect_direction(p, at, p.to_sphere(at.chart, static_cast<float>(at.u), static_cast<float>(at.v)));
      if (::testing::Test::HasFatalFailure()) return;
    }
  });
}

TEST(ParameterizationPrecision, FloatPositionsAgreeWithDouble) {
  for_all([](const Case& p) {
    for (const Vec3d& d : all_directions()) {
      expect_position(p, rounded(d), p.from_sphere(rounded(d)));
      if (::testing::Test::HasFatalFailure()) return;
    }
  });
}

TEST(ParameterizationPrecision, FloatDensityAgreesWithDouble) {
  for_all([](const Case& p) {
    for (const Position& at : float_positions(p, 0.001, 0.999)) {
      if (!well_inside(p, at, 0.005)) continue;
      expect_density(p, at,
                     p.solid_angle_density(at.chart, static_cast<float>(at.u), static_cast<float>(at.v)));
      if (::testing::Test::HasFatalFailure()) return;
    }
  });
}

TEST(ParameterizationPrecision, PacksAgreeWithDoubleInEveryLane) {
  for_all([](const Case& p) {
    for (int chart = 0; chart < p.charts; ++chart) {
      const std::vector<Position> positions = float_positions_of(p, chart, 0, 1);
      for (std::size_t i = 0; i < positions.size(); i += Pack::size) {
        float us[Pack::size], vs[Pack::size];
        for (std::size_t lane = 0; lane < Pack::size; ++lane) {
          us[lane] = static_cast<float>(positions[i + lane].u);
          vs[lane] = static_cast<float>(positions[i + lane].v);
        }
        const Pack u = Pack::load_unaligned(us), v = Pack::load_unaligned(vs);
        const Vec3<Pack> d = p.to_sphere(chart, u, v);
        const Pack density = p.solid_angle_density(chart, u, v);
        const Mask<Pack> valid = p.valid(chart, u, v);
        for (std::size_t lane = 0; lane < Pack::size; ++lane) {
          const Position& at = positions[i + lane];
          if (well_inside(p, at, 0.005)) expect_density(p, at, density.get(lane));
          if (well_inside(p, at, 1e-6)) {
            ASSERT_TRUE(valid.get(lane)) << at.u << " " << at.v;
          }
          if (p.valid(at.chart, at.u, at.v)) {
            expect_direction(p, at, {d.x.get(lane), d.y.get(lane), d.z.get(lane)});
          }
          if (::testing::Test::HasFatalFailure()) return;
        }
      }
    }
  });
}

TEST(ParameterizationPrecision, PacksFindTheirPositionsWithADifferentChartInEveryLane) {
  for_all([](const Case& p) {
    std::vector<Vec3d> directions = all_directions();
    // Neighbours of the list go to different lanes' charts.
    std::shuffle(directions.begin(), directions.end(), std::mt19937(1));
    int packs_of_several_charts = 0;
    for (std::size_t i = 0; i + Pack::size <= directions.size(); i += Pack::size) {
      float x[Pack::size], y[Pack::size], z[Pack::size];
      for (std::size_t lane = 0; lane < Pack::size; ++lane) {
        const Vec3<float> d = rounded(directions[i + lane]);
        x[lane] = d.x, y[lane] = d.y, z[lane] = d.z;
      }
      const Vec3<Pack> d{Pack::load_unaligned(x), Pack::load_unaligned(y), Pack::load_unaligned(z)};
      const ChartPoint<Pack> at = p.from_sphere(d);
      const Mask<Pack> covered = p.covers(d);
      for (std::size_t lane = 0; lane < Pack::size; ++lane) {
        const Vec3<float> one{x[lane], y[lane], z[lane]};
        expect_position(p, one, {at.chart.get(lane), at.u.get(lane), at.v.get(lane)});
        ASSERT_EQ(covered.get(lane), p.covers(one)) << one.x << " " << one.y << " " << one.z;
        if (::testing::Test::HasFatalFailure()) return;
      }
      packs_of_several_charts += at.chart.get(0) != at.chart.get(1) ? 1 : 0;
    }
    if (p.charts > 1) {
      EXPECT_GT(packs_of_several_charts, 1000);
    }
  });
}

/// Packs are finite, of unit length and as double says in the margin, where borders are filled.
TEST(ParameterizationPrecision, PacksAgreeWithDoubleInTheMargin) {
  for_all([](const Case& p) {
    for (const Position& at : float_positions(p, -1, 2)) {
      const Vec3<Pack> d =
          p.to_sphere(at.chart, Pack(static_cast<float>(at.u)), Pack(static_cast<float>(at.v)));
      // Angles up to 6 turns, and coordinates up to 2, are rounded to four times as much.
      const double allowed = 4 * kDirectionError + wobble(p, at.chart, at.u, at.v, 4 * kInputRounding);
      const Vec3<float> first{d.x.get(0), d.y.get(0), d.z.get(0)};
      ASSERT_LE(distance(widened(first), p.to_sphere(at.chart, at.u, at.v)), allowed) << at.u << " " << at.v;
    }
  });
}

/// The error that polar.h states, on the axes too, for any length and from 1e-7 radians to the whole turn.
TEST(PolarAngle, OfPacksIsThatOfDouble) {
  for (int i = -4000; i <= 4000; ++i) {
    const double turn = kPi * i / 4000;
    for (const double angle : {turn, turn + 1e-7, turn - 1e-4}) {
      for (const double length : {1.0, 1.7e-30, 2.3e30}) {
        const auto y = static_cast<float>(length * std::sin(angle)),
                   x = static_cast<float>(length * std::cos(angle));
        const double found = polar_angle(Pack(y), Pack(x)).get(0), exact = std::atan2(y, x);
        ASSERT_NEAR(found, exact, 4e-7) << angle << " " << length;
      }
    }
  }
  const Pack zero(0.0f), one(1.0f);
  EXPECT_EQ(polar_angle(zero, zero).get(0), 0);
  EXPECT_EQ(polar_angle(zero, one).get(0), 0);
  EXPECT_FLOAT_EQ(polar_angle(one, zero).get(0), static_cast<float>(kPi / 2));
  EXPECT_FLOAT_EQ(polar_angle(zero, -one).get(0), static_cast<float>(kPi));
}

}  // namespace
}  // namespace welkin::sphere
