#pragma once

#include <cmath>

#include "welkin/math/vec.h"

/// Unit vectors where there may be none.
namespace welkin {

/// v at unit length; `otherwise` where it has no direction (0, NaN, infinite).
inline Vec3d unit_or(const Vec3d& v, const Vec3d& otherwise) {
  const double size = length(v);
  return size > 1e-300 && std::isfinite(size) ? (1 / size) * v : otherwise;
}

/// Some unit vector at right angles to a unit vector.
inline Vec3d across(const Vec3d& normal) {
  return normalize(std::abs(normal.y) < 0.9 ? cross({0, 1, 0}, normal) : cross({1, 0, 0}, normal));
}

}  // namespace welkin
