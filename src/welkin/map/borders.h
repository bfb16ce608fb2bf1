#pragma once

#include "welkin/base/export.h"
#include "welkin/map/map.h"

/// @file
/// What lies past a chart's edge.
namespace welkin {

/// What texels on the rim of a disc hold whose centre is not valid.
enum class RimTexels {
  made,      ///< nothing: they get what lies beside them, as those farther out
  kept,      ///< their own light
  measured,  ///< of pictures of unknown origin: their own light if most are within a quarter of what lies
             ///< beside them; not in pictures that show black or something else around a disc. Values that
             ///< aren't finite are none
};

/// Fills every chart's border, and the texels inside a chart that are no position of the map (the corners of
/// a disc) as far as a kernel reaches over the rim. This is the only function that knows what lies past a
/// chart's edge.
///
/// Each such texel lies, by the chart's extended domain, in some direction. It takes the value that the map
/// has there: the texel itself where that direction is a texel centre of another chart (lat-long, octahedra),
/// else the Catmull–Rom interpolation of that chart (cubes, discs). Where the map shows nothing (behind a
/// hemisphere) it takes the mean of its neighbours that do, ring by ring.
///
/// Texels that the rim of a disc cuts are part of the map, and hold the mean over their valid part. Of those
/// whose centre is not valid, `rim` says whether they do.
WELKIN_API void fill_borders(const sphere::AnyParameterization& parameterization, Level& level,
                             RimTexels rim = RimTexels::made);

/// Those of a map. Call it after texels were written through a view.
inline void fill_borders(Map& map, RimTexels rim = RimTexels::made) {
  fill_borders(map.parameterization, map.level, rim);
}

}  // namespace welkin
