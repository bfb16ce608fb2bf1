#include "welkin/lookup/texel_shape.h"

#include <algorithm>
#include <cmath>

namespace welkin {
namespace {

constexpr int kPoints = 33;
/// Of the longer side, that a texel counts as at least.
constexpr double kThinnest = 0.25;
constexpr double kVanishing = 1e-3;

struct Sides {
  Vec3d right, down;
};

/// By differences over a texel about a position, taken inside the chart: past an octahedron's edge positions
/// fold back, and half of a difference would vanish. Less where a texel is so large that its ends meet.
Sides sides_at(const sphere::AnyParameterization& p, ChartSize size, int chart, double u, double v) {
  constexpr double kLongest = 1.0 / 64;
  const double du = std::min(0.5 / size.width, kLongest), dv = std::min(0.5 / size.height, kLongest);
  u = clamp(u, du, 1 - du);
  v = clamp(v, dv, 1 - dv);
  return {(0.5 / (du * size.width)) * (p.to_sphere(chart, u + du, v) - p.to_sphere(chart, u - du, v)),
          (0.5 / (dv * size.height)) * (p.to_sphere(chart, u, v + dv) - p.to_sphere(chart, u, v - dv))};
}

PlanePoint operator*(double s, const PlanePoint& p) {
  return {s * p.x, s * p.y};
}
PlanePoint operator+(const PlanePoint& a, const PlanePoint& b) {
  return {a.x + b.x, a.y + b.y};
}
double cross(const PlanePoint& a, const PlanePoint& b) {
  return a.x * b.y - a.y * b.x;
}
double length(const PlanePoint& p) {
  return std::hypot(p.x, p.y);
}

/// M C Mᵀ, with M's columns a and b.
Covariance transformed(const Covariance& c, const PlanePoint& a, const PlanePoint& b) {
  const PlanePoint first = c.xx * a + c.xy * b, second = c.xy * a + c.yy * b;
  return {first.x * a.x + second.x * b.x, first.x * a.y + second.x * b.y, first.y * a.y + second.y * b.y};
}

}  // namespace

PlanePoint TexelSides::to_plane(const PlanePoint& texels) const {
  return texels.x * right + texels.y * down;
}

PlanePoint TexelSides::to_texels(const PlanePoint& point) const {
  const double area = cross(right, down);
  return {cross(point, down) / area, cross(right, point) / area};
}

Covariance TexelSides::to_plane(const Covariance& texels) const {
  return transformed(texels, right, down);
}

Covariance TexelSides::to_texels(const Covariance& plane) const {
  const double area = cross(right, down);
  return transformed(plane, {down.y / area, -right.y / area}, {-down.x / area, right.x / area});
}

TexelSides texel_sides(const sphere::AnyParameterization& p, ChartSize size, const TangentPlane& plane) {
  const auto position = p.from_sphere(plane.normal);
  const Sides sides = sides_at(p, size, static_cast<int>(position.chart), position.u, position.v);
  TexelSides texel{{dot(plane.right, sides.right), dot(plane.down, sides.right)},
                   {dot(plane.right, sides.down), dot(plane.down, sides.down)}};
  const double right = length(texel.right), down = length(texel.down), longer = std::max(right, down);
  // A square of the mean texel's size, where there is nothing to go by.
  if (!(longer > 0) || !std::isfinite(longer)) {
    const double side =
        std::sqrt(p.coverage() / (static_cast<double>(p.charts()) * size.width * size.height));
    return {{side, 0}, {0, side}};
  }
  // Along a side what is there is kept, and what lacks to a parallelogram is added across.
  const double area = cross(texel.right, texel.down), least = kVanishing * longer * longer;
  if (std::fabs(area) >= least) return texel;
  const double lacking = std::copysign(least, area) - area;
  if (right < down) {
    const PlanePoint across = (1 / down) * PlanePoint{texel.down.y, -texel.down.x};
    texel.right = texel.right + (lacking / down) * across;
  } else {
    const PlanePoint across = (1 / right) * PlanePoint{-texel.right.y, texel.right.x};
    texel.down = texel.down + (lacking / right) * across;
  }
  return texel;
}

TexelSquares::TexelSquares(const sphere::AnyParameterization& p, ChartSize size) : p_(p) {
  const double mean = p.coverage() / (static_cast<double>(p.charts()) * size.width * size.height);
  for (int chart = 0; chart < p.charts(); ++chart) {
    for (int k = 0; k < kPoints * kPoints; ++k) {
      const double u = (k % kPoints) / (kPoints - 1.0), v = (k / kPoints) / (kPoints - 1.0);
      const Sides sides = sides_at(p, size, chart, u, v);
      const double longer = std::max(dot(sides.right, sides.right), dot(sides.down, sides.down));
      const double area =
          std::max(length(welkin::cross(sides.right, sides.down)), kThinnest * kThinnest * longer);
      areas_.push_back(static_cast<float>(area > 0 && std::isfinite(area) ? area : mean));
    }
  }
}

float TexelSquares::area_at(float chart, float u, float v) const {
  constexpr float kCells = kPoints - 1;
  const float x = std::clamp(u, 0.0f, 1.0f) * kCells, y = std::clamp(v, 0.0f, 1.0f) * kCells;
  const int column = std::min(static_cast<int>(x), kPoints - 2),
            row = std::min(static_cast<int>(y), kPoints - 2);
  const float fx = x - static_cast<float>(column), fy = y - static_cast<float>(row);
  const float* at = areas_.data() + (static_cast<int>(chart) * kPoints + row) * kPoints + column;
  const float above = at[0] + fx * (at[1] - at[0]);
  const float below = at[kPoints] + fx * (at[kPoints + 1] - at[kPoints]);
  return above + fy * (below - above);
}

void TexelSquares::areas_at(const float* x, const float* y, const float* z, std::size_t count,
                            float* areas) const {
  constexpr std::size_t kBatch = 64;
  float chart[kBatch], u[kBatch], v[kBatch];
  for (std::size_t from = 0; from < count; from += kBatch) {
    const std::size_t here = std::min(kBatch, count - from);
    p_.kernels().from_sphere(p_.self(), x + from, y + from, z + from, chart, u, v, here);
    for (std::size_t i = 0; i < here; ++i) areas[from + i] = area_at(chart[i], u[i], v[i]);
  }
}

}  // namespace welkin
