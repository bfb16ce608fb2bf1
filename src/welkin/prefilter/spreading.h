#pragma once

#include "welkin/base/monitor.h"
#include "welkin/prefilter/point_grid.h"

/// Spreading: the first step of a type-1 non-uniform transform, from points at any positions to a grid.
namespace welkin::prefilter {

/// Fills `grid` from any map, texel by texel: points of each texel (texel_points.h), weighted by solid angle,
/// spread over 6×6 grid points by Lagrange interpolation of degree five. The same sums whatever the number of
/// threads. Throws Cancelled.
void spread_texels(const Map& map, PointGrid& grid, const Monitor& monitor);

}  // namespace welkin::prefilter
