#pragma once

#include <functional>

#include "welkin/base/export.h"
#include "welkin/harmonics/harmonics.h"

/// @file
/// The least value of a function on the sphere.
namespace welkin::harmonics {

/// Where a function has a value.
struct Extremum {
  Vec3d direction{0, 1, 0};  ///< unit
  double value = 0;          ///< there
};

/// The least value of a channel over the whole sphere. Up to degree 2 the function is a quadratic form plus a
/// linear one, and the minimum is exact (a trust-region subproblem: Moré & Sorensen 1983); above, every
/// minimum of a grid of an eighth of the shortest wave that may lie over the least is refined to 1e-9 of a
/// radian.
WELKIN_API Extremum minimum_of(const SphericalHarmonics& harmonics, int channel);

/// @cond INTERNAL
/// values[i] of directions[i], of a function without waves shorter than 2π/degree.
using ValuesOnSphere = std::function<void(std::span<const Vec3d> directions, std::span<double> values)>;
Extremum minimum_on_sphere(const ValuesOnSphere& function, int degree);
/// @endcond

}  // namespace welkin::harmonics
