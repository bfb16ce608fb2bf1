/// Laws of every parameterization in double precision: inverse both ways, unit length, density, coverage,
/// orientation.

#include <string_view>

#include "welkin/sphere/parameterization_cases.h"

namespace welkin::sphere {
namespace {

using namespace cases;

TEST(Parameterization, PositionToDirectionAndBackIsTheSamePosition) {
  for_all([](const Case& p) {
    int checked = 0;
    for (const Position& at : random_positions(p.charts, 20000, 0, 1)) {
      if (!well_inside(p, at, 1e-6)) continue;
      const ChartPoint<double> back = p.from_sphere(p.to_sphere(at.chart, at.u, at.v));
      ASSERT_EQ(back.chart, at.chart) << at.u << " " << at.v;
      // 1e-9: rounding of 1e-16 at 1e-6 from a pole, with room.
      ASSERT_NEAR(back.u, at.u, 1e-9) << at.chart << " " << at.v;
      ASSERT_NEAR(back.v, at.v, 1e-9) << at.chart << " " << at.u;
      ++checked;
    }
    EXPECT_GT(checked, 8000);
  });
}

TEST(Parameterization, DirectionToPositionAndBackIsTheSameDirection) {
  for_all([](const Case& p) {
    for (const Vec3d& d : all_directions()) {
      const ChartPoint<double> at = p.from_sphere(d);
      ASSERT_TRUE(std::isfinite(at.u) && std::isfinite(at.v)) << d.x << " " << d.y << " " << d.z;
      ASSERT_TRUE(at.chart >= 0 && at.chart < p.charts && at.chart == std::floor(at.chart)) << at.chart;
      if (!p.covers(d)) continue;
      const int chart = static_cast<int>(at.chart);
      const double allowed = 1e-13 + wobble(p, chart, at.u, at.v, 1e-15);
      ASSERT_LE(distance(p.to_sphere(chart, at.u, at.v), d), allowed) << d.x << " " << d.y << " " << d.z;
    }
  });
}

TEST(Parameterization, CoveredDirectionsLandOnValidPositions) {
  for_all([](const Case& p) {
    for (const Vec3d& d : all_directions()) {
      if (!p.covers(d)) continue;
      const ChartPoint<double> at = p.from_sphere(d);
      // Drawn toward the chart's centre by more than rounding.
      const double u = 0.5 + (at.u - 0.5) * (1 - 1e-9), v = 0.5 + (at.v - 0.5) * (1 - 1e-9);
      ASSERT_TRUE(u >= 0 && u <= 1 && v >= 0 && v <= 1) << u << " " << v;
      ASSERT_TRUE(p.valid(static_cast<int>(at.chart), u, v)) << u << " " << v;
    }
  });
}

TEST(Parameterization, LengthOfTheDirectionDoesNotMatter) {
  for_all([](const Case& p) {
    for (const Vec3d& d : spread_directions(1000)) {
      const ChartPoint<double> a = p.from_sphere(d), b = p.from_sphere(8.0 * d), c = p.from_sphere(0.125 * d);
      ASSERT_EQ(a.chart, b.chart);
      ASSERT_NEAR(a.u, b.u, 1e-14);
      ASSERT_NEAR(a.v, b.v, 1e-14);
      ASSERT_NEAR(a.u, c.u, 1e-14);
      ASSERT_NEAR(a.v, c.v, 1e-14);
      ASSERT_EQ(p.covers(d), p.covers(8.0 * d));
    }
  });
}

TEST(Parameterization, DirectionsHaveUnitLengthInTheMarginToo) {
  for_all([](const Case& p) {
    for (const Position& at : random_positions(p.charts, 20000, -1, 2)) {
      ASSERT_NEAR(length(p.to_sphere(at.chart, at.u, at.v)), 1, 1e-14) << at.u << " " << at.v;
    }
  });
}

TEST(Parameterization, DensityIsTheAreaSpannedByTheDerivatives) {
  for_all([](const Case& p) {
    int checked = 0;
    for (const Position& at : lattice_positions(p.charts, 48)) {
      if (!well_inside(p, at, 0.005)) continue;
      const Tangents t = tangents(p, at, 1e-5);
      const double density = p.solid_angle_density(at.chart, at.u, at.v);
      // Central differences are off by step²/6 times the third derivative, at most about 1/0.005² near a rim.
      ASSERT_NEAR(length(cross(t.along_u, t.along_v)), density, 2e-5 * density) << at.u << " " << at.v;
      ++checked;
    }
    EXPECT_GT(checked, 900);
  });
}

TEST(Parameterization, DensityIsFiniteAndNeverNegativeOnTheWholeChart) {
  for_all([](const Case& p) {
    for (int chart = 0; chart < p.charts; ++chart) {
      for (int j = 0; j <= 64; ++j) {
        for (int i = 0; i <= 64; ++i) {
          const double u = i / 64.0, v = j / 64.0;
          if (!p.valid(chart, u, v)) continue;
          const double density = p.solid_angle_density(chart, u, v);
          ASSERT_TRUE(std::isfinite(density)) << u << " " << v;
          ASSERT_GE(density, -1e-12) << u << " " << v;
        }
      }
    }
  });
}

TEST(Parameterization, DensityByRowDependsOnTheRowAlone) {
  for_all([](const Case& p) {
    if (!p.density_by_row) return;
    for (const Position& at : random_positions(p.charts, 200, 0.01, 0.99)) {
      ASSERT_NEAR(p.solid_angle_density(at.chart, at.u, at.v), p.solid_angle_density(at.chart, 0.5, at.v),
                  1e-12);
    }
  });
}

TEST(Parameterization, DensityAddsUpToTheCoverage) {
  for_all([](const Case& p) {
    // Points of Roberts' R2 sequence (2018), which favour no row, column or rim.
    const int points = 1000000;
    double sum = 0;
    for (int chart = 0; chart < p.charts; ++chart) {
      double u = 0.5, v = 0.5;
      for (int i = 0; i < points; ++i) {
        u += 0.7548776662466927, v += 0.5698402909980532;
        u -= std::floor(u), v -= std::floor(v);
        if (p.valid(chart, u, v)) sum += p.solid_angle_density(chart, u, v);
      }
    }
    sum /= points;
    // 3e-4: what a million points miss of a narrow peak or a disc; 3e-3 where the density is infinite at its
    // rim.
    const bool infinite_rim = p.solid_angle_density(0, 0.5, 1e-9) > 100 * p.solid_angle_density(0, 0.5, 0.5);
    EXPECT_NEAR(sum, p.coverage, (infinite_rim ? 3e-3 : 3e-4) * p.coverage);
  });
}

TEST(Parameterization, CoverageIsTheShareOfDirectionsCovered) {
  for_all([](const Case& p) {
    const std::vector<Vec3d> directions = spread_directions(20000);
    int covered = 0;
    for (const Vec3d& d : directions) covered += p.covers(d) ? 1 : 0;
    EXPECT_NEAR(covered / 20000.0, p.coverage / (4 * kPi), 2e-3);
  });
}

/// Seen from inside, right × down points the way that one looks. Photographs of balls are mirrored by nature,
/// and the look-up rules of cubes and octahedra by their field's custom (docs/parameterizations.md).
TEST(Parameterization, PicturesAreSeenFromInsideSaveTheMirroredOnes) {
  for_all([](const Case& p) {
    bool mirrored = false;
    for (const std::string_view name : {"sphere", "mirror-ball", "cube", "eac", "openexr-cube", "octahedral",
                                        "octahedral-rect", "octahedral-equal-area"}) {
      mirrored = mirrored || name == p.kind;
    }
    for (const Position& at : lattice_positions(p.charts, 16)) {
      if (!well_inside(p, at, 0.001)) continue;
      const Tangents t = tangents(p, at, 1e-5);
      const double side = dot(cross(t.along_u, t.along_v), p.to_sphere(at.chart, at.u, at.v));
      ASSERT_EQ(side < 0, mirrored) << at.chart << " " << at.u << " " << at.v;
    }
  });
}

}  // namespace
}  // namespace welkin::sphere
