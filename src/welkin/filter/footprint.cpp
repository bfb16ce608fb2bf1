#include "welkin/filter/footprint.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace welkin {
namespace {

/// A side of a texel, at least an eighth as long as the other one: so that thin texels at a pole do not get a
/// sample each.
Vec3d widened(const Vec3d& side, const Vec3d& other) {
  const double long_enough = length(other) / 8, now = length(side);
  return now > 0 && now < long_enough ? (long_enough / now) * side : side;
}

}  // namespace

double Footprint::right_length() const {
  return std::hypot(right[0], right[1]);
}
double Footprint::down_length() const {
  return std::hypot(down[0], down[1]);
}

double Footprint::narrow() const {
  // Singular values of a 2×2 matrix: σ₁σ₂ = |det|, σ₁² + σ₂² = ‖·‖².
  const double determinant = std::fabs(right[0] * down[1] - right[1] * down[0]);
  const double sum = right[0] * right[0] + right[1] * right[1] + down[0] * down[0] + down[1] * down[1];
  const double difference = std::sqrt(std::max(0.0, sum * sum - 4 * determinant * determinant));
  const double larger = std::sqrt(0.5 * (sum + difference));
  return larger > 0 ? determinant / larger : 0;
}

Footprint footprint_at(const Map& source, const MapFrame& target, const Matrix3& to_source, int chart,
                       double x, double y) {
  // Tangents on the sphere times a texel's size: differences over half a texel to each side, or less where a
  // texel is so large that its ends meet.
  const auto step = [](const sphere::AnyParameterization& p, int c, double u, double v, double texel_u,
                       double texel_v) {
    constexpr double kLongest = 1.0 / 16;
    const double part = std::min(1.0, kLongest / (texel_u + texel_v));
    const double du = 0.5 * part * texel_u, dv = 0.5 * part * texel_v;
    return (1 / part) * (p.to_sphere(c, u + du, v + dv) - p.to_sphere(c, u - du, v - dv));
  };
  const auto& t = target.parameterization;
  const double u = x / target.size.width, v = y / target.size.height;
  const Vec3d right = to_source * step(t, chart, u, v, 1.0 / target.size.width, 0);
  const Vec3d down = to_source * step(t, chart, u, v, 0, 1.0 / target.size.height);

  const auto& s = source.parameterization;
  const auto position = s.from_sphere(to_source * t.to_sphere(chart, u, v));
  const int source_chart = static_cast<int>(position.chart);
  // Half a texel inside the chart: past an octahedron's edge positions fold back, and their difference
  // would vanish.
  const double texel_u = 1.0 / source.width(), texel_v = 1.0 / source.height();
  const double su = clamp(position.u, 0.5 * texel_u, 1 - 0.5 * texel_u),
               sv = clamp(position.v, 0.5 * texel_v, 1 - 0.5 * texel_v);
  const Vec3d across = step(s, source_chart, su, sv, texel_u, 0),
              along = step(s, source_chart, su, sv, 0, texel_v);
  const Vec3d texel_right = widened(across, along), texel_down = widened(along, across);

  // Least squares: texel_right·a + texel_down·b ≈ step. The small term keeps it finite where the two are
  // parallel.
  const double tiny = 1e-14 + 1e-9 * (dot(texel_right, texel_right) + dot(texel_down, texel_down));
  const double rr = dot(texel_right, texel_right) + tiny, dd = dot(texel_down, texel_down) + tiny;
  const double rd = dot(texel_right, texel_down);
  const double determinant = rr * dd - rd * rd;
  const auto solve = [&](const Vec3d& d, double* out) {
    const double r = dot(d, texel_right), b = dot(d, texel_down);
    out[0] = (r * dd - b * rd) / determinant;
    out[1] = (b * rr - r * rd) / determinant;
  };
  Footprint footprint{};
  solve(right, footprint.right);
  solve(down, footprint.down);
  return footprint;
}

FootprintSides footprints_of(const Map& source, const MapFrame& target, const Matrix3& to_source) {
  struct Side {
    double length, solid_angle;
  };
  std::vector<Side> sides;
  double total = 0;
  constexpr int kGrid = 24;
  for (int chart = 0; chart < target.parameterization.charts(); ++chart) {
    for (int i = 0; i < kGrid * kGrid; ++i) {
      const double u = (i % kGrid + 0.5) / kGrid, v = (i / kGrid + 0.5) / kGrid;
      if (!target.parameterization.valid(chart, u, v)) continue;
      const double length =
          footprint_at(source, target, to_source, chart, u * target.size.width, v * target.size.height)
              .narrow();
      sides.push_back({length, target.parameterization.solid_angle_density(chart, u, v)});
      total += sides.back().solid_angle;
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.length < b.length; });
  FootprintSides found{HUGE_VAL, HUGE_VAL};
  double narrower = 0;
  for (const Side& side : sides) {
    narrower += side.solid_angle;
    if (narrower > 0.05 * total) found.narrow = std::min(found.narrow, side.length);
    if (narrower > 0.5 * total) found.typical = std::min(found.typical, side.length);
  }
  return found;
}

bool is_reconstructed(double narrow_side) {
  return narrow_side < 1.75;
}

bool is_reconstructed(const Map& source, const MapFrame& target, const Matrix3& to_source) {
  return is_reconstructed(footprints_of(source, target, to_source).narrow);
}

}  // namespace welkin
