#pragma once

#include <cstdint>

#include "welkin/base/export.h"
#include "welkin/map/map.h"

/// @file
/// Changes to a map's values, or to the world it shows. Borders stay filled where they were.
namespace welkin {

/// Every value times `factor`, which is finite, but for the channel A; borders too.
WELKIN_API void scale(Map& map, float factor);

/// Replaces every value of the charts (also outside discs) that is NaN or infinite by the mean of the finite
/// values of its channel among its eight neighbours in the chart, else by `replacement`. Returns how many
/// texels had such a value; where it isn't 0, the borders are filled again.
WELKIN_API std::uint64_t sanitize(Map& map, float replacement = 0);

/// Rotates the world: what was seen along d is seen along rotation·d afterwards. Changes no pixel. Throws
/// Error (bad_request) for a matrix that is not orthonormal.
WELKIN_API void turn_world(Map& map, const Matrix3& rotation);

/// A copy of a map of R G B A without A.
WELKIN_API Map without_alpha(const Map& map);

}  // namespace welkin
