#pragma once

#include <vector>

#include "welkin/base/export.h"
#include "welkin/sphere/registry.h"

/// @file
/// Where a picture of part of the world ends.
namespace welkin {

/// The directions within an angle of an axis.
struct WELKIN_API Cap {
  Vec3d axis;         ///< its centre, of unit length
  double radius = 0;  ///< radians, 0 … π: of half the sphere π/2

  /// How far inside the cap's edge a unit direction lies, radians; negative outside.
  double depth(const Vec3d& direction) const;
};

/// The caps that have in common what a parameterization shows: a flat picture has four halves of the sphere,
/// a fish-eye one cap, a whole world none. Directions are the parameterization's. Throws Error (unsupported)
/// for one that shows anything else, as a lat-long's window does that is wider than 180°.
WELKIN_API std::vector<Cap> edges_of(const sphere::AnyParameterization& parameterization);

}  // namespace welkin
