#pragma once

#include <cmath>
#include <optional>

#include "welkin/math/vec.h"

/// Directions away from a facet, of unit length like its normal `h`.
namespace welkin::scene {

inline Vec3d reflect(const Vec3d& v, const Vec3d& h) {
  return (2 * dot(v, h)) * h - v;
}

/// Behind facets that `v` sees, v·h > 0; `eta` is the index there over that before. None where all is
/// reflected.
inline std::optional<Vec3d> bend(const Vec3d& v, const Vec3d& h, double eta) {
  const double ratio = 1 / eta, c = dot(v, h), square = 1 - ratio * ratio * (1 - c * c);
  if (!(square > 0)) return std::nullopt;
  return normalize((ratio * c - std::sqrt(square)) * h - ratio * v);
}

}  // namespace welkin::scene
