#pragma once

#include <algorithm>
#include <cmath>

#include "welkin/math/vec.h"

/// The plane of directions near one: angles from it, and ellipses there.
namespace welkin {

struct PlanePoint {
  double x, y;
};

/// Second moments in a plane: a symmetric 2×2 matrix.
struct Covariance {
  double xx, xy, yy;
};

/// The same as lengths: σ along the wide axis, across it, and the wide axis's angle from +x, radians.
struct Ellipse {
  double wide, narrow, angle;
};

inline Ellipse ellipse_of(const Covariance& c) {
  const double middle = 0.5 * (c.xx + c.yy), half = std::hypot(0.5 * (c.xx - c.yy), c.xy);
  // The smaller eigenvalue as determinant over larger one: no cancellation.
  const double larger = middle + half;
  const double smaller = larger > 0 ? std::max(0.0, c.xx * c.yy - c.xy * c.xy) / larger : 0;
  return {std::sqrt(larger), std::sqrt(smaller), half > 0 ? 0.5 * std::atan2(2 * c.xy, c.xx - c.yy) : 0};
}

inline Covariance covariance_of(const Ellipse& e) {
  const double c = std::cos(e.angle), s = std::sin(e.angle);
  const double wide = e.wide * e.wide, narrow = e.narrow * e.narrow;
  return {c * c * wide + s * s * narrow, c * s * (wide - narrow), s * s * wide + c * c * narrow};
}

/// An orthonormal frame at a direction: `normal` points along it, the other two are tangents of the sphere.
struct TangentPlane {
  Vec3d normal, right, down;

  /// About a unit direction, turned anyhow.
  explicit TangentPlane(const Vec3d& direction) : normal(direction) {
    // Any axis that is not near the direction (Hughes & Möller 1999).
    const Vec3d other = std::fabs(direction.y) < 0.7 ? Vec3d{0, 1, 0} : Vec3d{1, 0, 0};
    right = normalize(cross(other, direction));
    down = cross(direction, right);
  }
  /// With `axis`, which is not parallel to the unit direction, made its right.
  TangentPlane(const Vec3d& direction, const Vec3d& axis)
      : normal(direction), right(normalize(axis - dot(axis, direction) * direction)) {
    down = cross(direction, right);
  }

  /// Where a unit direction lies: its angle from the normal, along the great circle to it. The one opposite
  /// the normal lies nowhere, and comes out at distance π.
  PlanePoint logarithm(const Vec3d& d) const {
    const double x = dot(right, d), y = dot(down, d), sine = std::hypot(x, y);
    const double angle = std::atan2(sine, dot(normal, d));
    if (!(sine > 0)) return {angle, 0};
    return {x / sine * angle, y / sine * angle};
  }
  /// The unit direction at a point.
  Vec3d exponential(const PlanePoint& p) const {
    const double angle = std::hypot(p.x, p.y);
    const double scale = angle > 0 ? std::sin(angle) / angle : 1;
    return std::cos(angle) * normal + (scale * p.x) * right + (scale * p.y) * down;
  }
};

}  // namespace welkin
