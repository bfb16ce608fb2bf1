#pragma once

#include "welkin/base/export.h"
#include "welkin/map/map.h"

/// @file
/// What lies past a chart's edge.
namespace welkin {

/// Fills every chart's border, and the texels inside a chart that are no position of the map (the corners of
/// a disc) as far as a kernel reaches over the rim. This is the only function that knows what lies past a
/// chart's edge.
///
/// Each such texel lies, by the chart's extended domain, in some direction. It takes the value that the map
/// has there: the texel itself where that direction is a texel centre of another chart (lat-long, octahedra),
/// else the Catmull–Rom interpolation of that chart (cubes, discs). Where the map shows nothing (behind a
/// hemisphere) it takes the mean of its neighbours that do, ring by ring.
WELKIN_API void fill_borders(const sphere::AnyParameterization& parameterization, Level& level);

/// Those of a map. Call it after texels were written through a view.
inline void fill_borders(Map& map) {
  fill_borders(map.parameterization, map.level);
}

}  // namespace welkin
