#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "welkin/base/export.h"
#include "welkin/map/map.h"

/// @file
/// Changes to a map's values, or to the world it shows. Borders stay filled where they were.
namespace welkin {

/// Every value times `factor`, which is finite, but for the channel A; borders too.
WELKIN_API void scale(Map& map, float factor);

/// What sanitize() makes of values that no light has.
struct SanitizeOptions {
  /// Replace NaN, and infinite values unless `infinite` says what these become, by what is around them.
  bool fill = true;
  /// What a chart without any finite value of a channel is filled with; finite.
  float replacement = 0;
  /// What +∞ becomes, positive: 65504 for instance. Not of the channel A.
  std::optional<float> infinite = {};
  /// −∞ becomes −infinite; else 0.
  bool negative_infinite = true;
  /// Afterwards values below or above these are clamped to them, infinite ones too; not of the channel A.
  /// @{
  float minimum = -std::numeric_limits<float>::infinity();
  float maximum = std::numeric_limits<float>::infinity();
  /// @}
};

/// What sanitize() did.
struct SanitizeReport {
  std::uint64_t filled = 0;    ///< texels with a value that was replaced by what is around it
  std::uint64_t infinite = 0;  ///< values that became ±SanitizeOptions::infinite, or 0
  std::uint64_t clamped = 0;   ///< values clamped to the minimum or the maximum
};

/// Repairs the values of the charts, also outside discs, channel by channel; fills the borders again where it
/// changed any.
///
/// Holes of any size are filled from their rim inward: a value becomes the mean of those among its eight
/// neighbours that are finite, ring by ring; what is farther in than the first ring is then smoothed.
/// Neighbours are those on the sphere, across the edges of charts and the date line; a texel inside a disc
/// takes nothing from outside. So values stay within the range of what surrounds the hole. Takes time in
/// proportion to the holes. The same result whatever the number of threads.
///
/// Throws Error (bad_request) for options that are NaN, not finite where they have to be, or a minimum above
/// the maximum.
WELKIN_API SanitizeReport sanitize(Map& map, const SanitizeOptions& options = {});

/// Rotates the world: what was seen along d is seen along rotation·d afterwards. Changes no pixel. Throws
/// Error (bad_request) for a matrix that is not orthonormal.
WELKIN_API void turn_world(Map& map, const Matrix3& rotation);

/// A copy of a map of R G B A without A.
WELKIN_API Map without_alpha(const Map& map);

}  // namespace welkin
