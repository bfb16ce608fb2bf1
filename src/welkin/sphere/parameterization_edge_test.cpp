/// What lies past the edges of a chart: continuity, and that covered directions there are found again on a
/// chart.

#include "welkin/sphere/parameterization_cases.h"

namespace welkin::sphere {
namespace {

using namespace cases;

struct Uv {
  double u, v;
};

Uv between(const Uv& a, const Uv& b, double t) {
  return {a.u + t * (b.u - a.u), a.v + t * (b.v - a.v)};
}

/// Walks from a to b in `steps`. Where two neighbours are far apart, halves the step on the side of the
/// larger jump until it is 1e-12 long; the largest jump that is left. √1e-12 = 1e-6 at the steepest of
/// singular points.
double largest_jump(const Case& p, int chart, const Uv& a, const Uv& b, int steps) {
  const auto direction = [&](const Uv& at) { return p.to_sphere(chart, at.u, at.v); };
  double largest = 0;
  for (int i = 0; i < steps; ++i) {
    Uv from = between(a, b, 1.0 * i / steps), to = between(a, b, (i + 1.0) / steps);
    double jump = distance(direction(from), direction(to));
    for (int halving = 0; halving < 32 && jump > 1e-4; ++halving) {
      const Uv middle = between(from, to, 0.5);
      const double before = distance(direction(from), direction(middle));
      const double after = distance(direction(middle), direction(to));
      (before > after ? to : from) = middle;
      jump = std::max(before, after);
    }
    largest = std::max(largest, jump);
  }
  return largest;
}

TEST(ParameterizationEdge, GoesOnContinuouslyOverTheWholeMargin) {
  for_all([](const Case& p) {
    for (int chart = 0; chart < p.charts; ++chart) {
      for (int line = 0; line < 25; ++line) {
        const double at = -1 + 3 * (line + 0.481) / 25, other = -1 + 3 * (24 - line + 0.253) / 25;
        ASSERT_LT(largest_jump(p, chart, {-1, at}, {2, at}, 200), 1e-3) << "row " << at << " of " << chart;
        ASSERT_LT(largest_jump(p, chart, {at, -1}, {at, 2}, 200), 1e-3) << "column " << at << " of " << chart;
        ASSERT_LT(largest_jump(p, chart, {-1, at}, {2, other}, 200), 1e-3)
            << "line " << at << " of " << chart;
      }
    }
  });
}

TEST(ParameterizationEdge, CoveredDirectionsOfTheMarginAreFoundOnAChart) {
  for_all([](const Case& p) {
    for (const Position& position : random_positions(p.charts, 20000, -1, 2)) {
      const Vec3d d = p.to_sphere(position.chart, position.u, position.v);
      if (!p.covers(d)) continue;
      const ChartPoint<double> at = p.from_sphere(d);
      const int chart = static_cast<int>(at.chart);
      ASSERT_LE(distance(p.to_sphere(chart, at.u, at.v), d), 1e-13 + wobble(p, chart, at.u, at.v, 1e-15));
      ASSERT_TRUE(at.u >= -1e-12 && at.u <= 1 + 1e-12 && at.v >= -1e-12 && at.v <= 1 + 1e-12)
          << at.u << " " << at.v;
    }
  });
}

/// A step over an edge of the square comes down beside it: the same direction, up to the step, on whatever
/// chart.
TEST(ParameterizationEdge, AStepOverAnEdgeIsASmallStepOnTheSphere) {
  for_all([](const Case& p) {
    const double step = 1e-9;
    for (int chart = 0; chart < p.charts; ++chart) {
      for (int i = 0; i <= 100; ++i) {
        const double t = i / 100.0;
        const Uv outside[] = {{-step, t}, {1 + step, t}, {t, -step}, {t, 1 + step}};
        const Uv inside[] = {{step, t}, {1 - step, t}, {t, step}, {t, 1 - step}};
        for (int edge = 0; edge < 4; ++edge) {
          const Vec3d out = p.to_sphere(chart, outside[edge].u, outside[edge].v);
          const Vec3d in = p.to_sphere(chart, inside[edge].u, inside[edge].v);
          // 3e-4: 4 √(2 step), at the rims of the sphere map and the orthographic fish-eye; elsewhere 50
          // steps.
          ASSERT_LE(distance(out, in), 3e-4) << "edge " << edge << " at " << t;
          if (!p.covers(out)) continue;
          const ChartPoint<double> at = p.from_sphere(out);
          const int landed = static_cast<int>(at.chart);
          ASSERT_LE(distance(p.to_sphere(landed, at.u, at.v), out),
                    1e-13 + wobble(p, landed, at.u, at.v, 1e-15));
        }
      }
    }
  });
}

TEST(OctahedralEdges, PositionsPastAnEdgeAreOtherPositionsOfTheMap) {
  const auto check = [](const auto& p) {
    for (int i = 1; i < 64; ++i) {
      const double past = i / 64.0;
      for (int j = 0; j < 64; ++j) {
        const double along = (j + 0.5) / 64;
        ASSERT_LE(distance(p.to_sphere(0, 1 + past, along), p.to_sphere(0, 1 - past, 1 - along)), 1e-15);
        ASSERT_LE(distance(p.to_sphere(0, -past, along), p.to_sphere(0, past, 1 - along)), 1e-15);
        ASSERT_LE(distance(p.to_sphere(0, along, 1 + past), p.to_sphere(0, 1 - along, 1 - past)), 1e-15);
        ASSERT_LE(distance(p.to_sphere(0, along, -past), p.to_sphere(0, 1 - along, past)), 1e-15);
      }
    }
  };
  check(Octahedral{});
  check(OctahedralEqualArea{});
}

TEST(OctahedralEdges, RectanglePastAnEdgeIsTheOtherSquare) {
  const OctahedralRect p;
  for (int i = 1; i < 64; ++i) {
    const double past = i / 64.0;
    for (int j = 0; j < 64; ++j) {
      const double along = (j + 0.5) / 64;
      // Over the right edge of the left square, and over its bottom edge.
      ASSERT_LE(distance(p.to_sphere(0, 1 + past, along), p.to_sphere(1, past, along)), 1e-15);
      ASSERT_LE(distance(p.to_sphere(0, along, 1 + past), p.to_sphere(1, 1 - along, 1 - past)), 1e-15);
    }
  }
}

TEST(SphereMapEdges, PastTheRimThePictureGoesOnAcross) {
  const SphereMap p;
  for (int i = 0; i < 64; ++i) {
    const double angle = i * 0.1, r = 1 + i / 64.0;
    const double x = std::cos(angle), y = std::sin(angle);
    const Vec3d past = p.to_sphere(0, 0.5 + 0.5 * r * x, 0.5 + 0.5 * r * y);
    const Vec3d across = p.to_sphere(0, 0.5 - 0.5 * (2 - r) * x, 0.5 - 0.5 * (2 - r) * y);
    ASSERT_LE(distance(past, across), 1e-7) << r;
  }
}

}  // namespace
}  // namespace welkin::sphere
