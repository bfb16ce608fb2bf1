#pragma once

#include <vector>

#include "welkin/base/export.h"
#include "welkin/map/map.h"

/// @file
/// Coarser levels of a map.
namespace welkin {

/// How a pyramid averages the texels of the finer level.
enum class TexelWeight {
  solid_angle,  ///< each by the solid angle it covers (Heidrich & Seidel 1999, §4.3): keeps the map's energy
  equal,        ///< the plain 2×2 average, for comparison
};

/// The next coarser level: half the size in each axis, rounded up (an odd side's texels are shared between
/// their neighbours by overlap). Its borders are filled. `finer`'s own border is not read.
WELKIN_API Level reduce(const sphere::AnyParameterization& parameterization, const Level& finer,
                        TexelWeight weight = TexelWeight::solid_angle);

/// Levels 1 … `levels` of a map (its own is level 0), fewer when a side reaches one texel before. They need
/// about a third of the map's memory.
WELKIN_API std::vector<Level> make_pyramid(const Map& map, int levels,
                                           TexelWeight weight = TexelWeight::solid_angle);

/// How many coarser levels a map of this size has, down to one texel.
WELKIN_API int levels_below(int width, int height);

}  // namespace welkin
