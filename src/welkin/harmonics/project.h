#pragma once

#include "welkin/base/export.h"
#include "welkin/base/monitor.h"
#include "welkin/harmonics/harmonics.h"
#include "welkin/map/map.h"

/// @file
/// Maps ↔ spherical harmonics.
namespace welkin::harmonics {

/// The harmonics of a map's radiance up to a degree, of the map's world. Each texel is its radiance, constant
/// over its solid angle (prefilter/prefilter.h), and the coefficient is Σ L ∫ Y dω, to 1e-6 of the norm of
/// all; on the rim of a disc also of texels whose centre lies outside, which hold what is beside them
/// (fill_borders). Where the map shows nothing, radiance is 0. The channel A is left out, unless there is no
/// other.
///
/// Maps whose rows are latitudes (latlong, its windows, equal-area, cylinder…) take a few additions a value;
/// others time in proportion to texels · (degree + 1)². The same numbers whatever the number of threads.
///
/// Throws Error (bad_value) for texels with NaN or infinite values, and says how many there are and where the
/// first is; for radiance too large to add up (over 1e30); bad_request for a degree outside 0 … kMaxDegree;
/// Cancelled.
WELKIN_API SphericalHarmonics project(const Map& map, int degree, const Monitor& monitor = {});

/// A map with the harmonics' channels and names, of which `project` gives these harmonics back, to 1e-6 of
/// the norm: the means of their values over each texel, corrected for what means lose ((lπ/W)²/6 or so of
/// degree l), by conjugate gradients among functions of that degree. So it is the map with the least change
/// that has them, and its values may lie a little beyond the function's. Borders are filled; the orientation
/// is the identity unless told otherwise.
///
/// Of a parameterization that shows a part of the sphere, no map has them: it holds the means themselves.
///
/// Throws Error: bad_request where texels are too coarse for the degree (the message names the largest that
/// fits), as Map does for sizes; Cancelled.
WELKIN_API Map map_of(const SphericalHarmonics& harmonics,
                      const sphere::AnyParameterization& parameterization, ChartSize size,
                      const Matrix3& orientation = {}, const Monitor& monitor = {});

/// The largest degree that map_of takes for whole worlds of that size; at least 0.
WELKIN_API int largest_degree(const sphere::AnyParameterization& parameterization, ChartSize size);

}  // namespace welkin::harmonics
