#pragma once

#include <array>
#include <string>

#include "welkin/base/export.h"
#include "welkin/math/vec.h"

/// @file
/// The part of the world that a look-up sees: a cone around a direction, not the direction alone.
namespace welkin {

/// A cone with an elliptical Gaussian weight: exp(−½(x²/wide² + y²/narrow²)), x along `axis` and y across it,
/// both in radians from `direction`. It is the isotropic Gaussian of `narrow` spread along the great circle
/// through `direction` and `axis` by a wrapped Gaussian of variance wide² − narrow²: positive, normalised and
/// smooth for any width. A box of width w (a pixel) has the σ of w / √12.
struct EllipticalCone {
  Vec3<float> direction;  ///< its centre; of any length > 0
  Vec3<float> axis;       ///< along its wide side; of any length > 0, made perpendicular to `direction`. Any
                          ///< vector where `wide` equals `narrow`
  float wide = 0;         ///< σ along `axis`, radians, ≥ narrow
  float narrow = 0;       ///< σ across it, radians, ≥ 0
};

/// A cone over a spherical quadrilateral, all of which weighs alike: what a square pixel sees.
struct QuadCone {
  /// Its corners in order around it (either way): directions of any length > 0, all within a hemisphere. Two
  /// neighbours may be the same: a triangle.
  std::array<Vec3d, 4> corners;
};

/// What is wrong with a cone: a direction that is zero or not finite, a width that is negative or not a
/// number, `wide` below `narrow`, an axis that points nowhere across the direction where they differ. Empty:
/// nothing.
WELKIN_API std::string fault_of(const EllipticalCone& cone);
/// The same of corners: one that is zero or not finite, or 90° or more from the middle of all four.
WELKIN_API std::string fault_of(const QuadCone& cone);

}  // namespace welkin
