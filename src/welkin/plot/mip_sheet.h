#pragma once

#include "welkin/base/export.h"
#include "welkin/map/map.h"

/// @file
/// Pictures of pyramids.
namespace welkin {

/// A picture of a map's pyramid, twice, so that the two ways of averaging can be compared: above the plain
/// 2×2 means, below those weighted by solid angle. Each row shows the charts of the default layout's reading
/// order at level 0 to the last level of two texels, enlarged to the size of level 0 without interpolation.
/// RGB, linear, times 2^exposure.
WELKIN_API Image draw_mip_sheet(const Map& map, double exposure = 0);

}  // namespace welkin
