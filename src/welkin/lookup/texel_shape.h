#pragma once

#include <vector>

#include "welkin/lookup/tangent_plane.h"
#include "welkin/map/map.h"

/// How large texels are on the sphere, and which way they lie. Internal to lookup.
namespace welkin {

/// A 2×2 matrix: what one texel to the right and one down are in a tangent plane, by columns.
struct TexelSides {
  PlanePoint right, down;

  /// The matrix applied to a point in texels, and its inverse.
  PlanePoint to_plane(const PlanePoint& texels) const;
  PlanePoint to_texels(const PlanePoint& point) const;
  /// Second moments, from one to the other.
  Covariance to_plane(const Covariance& texels) const;
  Covariance to_texels(const Covariance& plane) const;
};

/// The sides of the texels of level 0 about a direction of the map. Never singular: a side that vanishes, as
/// at a pole, counts as a thousandth of the other one.
TexelSides texel_sides(const sphere::AnyParameterization& p, ChartSize size, const TangentPlane& plane);

/// The sides of squares as large as a map's texels, by position: the root of their solid angle, but at least
/// a quarter of their longer side, which at a pole is what remains. From a table of 33×33 points a chart,
/// linear between them.
class TexelSquares {
 public:
  TexelSquares(const sphere::AnyParameterization& p, ChartSize size);

  /// Radians², of level 0.
  float area_at(float chart, float u, float v) const;

  /// Of `count` directions of any length > 0. Arrays of sphere::padded(count).
  void areas_at(const float* x, const float* y, const float* z, std::size_t count, float* areas) const;

 private:
  sphere::AnyParameterization p_;
  std::vector<float> areas_;
};

}  // namespace welkin
