#pragma once

#include "welkin/base/export.h"
#include "welkin/map/map.h"

/// @file
/// Safety borders: charts written with texels of what lies past their edges, for renderers that look them up
/// as plain textures.
namespace welkin {

/// Throws Error (mismatch) when a border of so many texels is negative, or wider than a chart.
WELKIN_API void check_border(int border, ChartSize size);

/// Chart `index` with `border` texels around it: the texels of `fill_borders`, and further out the map read
/// bicubically along the directions that the chart's extended domain has there; the nearest texel where the
/// map shows nothing. Throws as check_border does.
WELKIN_API Image with_safety_border(const Map& map, int index, int border);

/// The coarsest level of a mip chain, made of plain 2×2 averages of the bordered chart, that a bilinear
/// look-up anywhere inside the chart may read: one whole texel of border is left, and no texel mixes border
/// and chart. That is the largest l for which 2^l divides the border and the chart's side; −1 without a
/// border.
WELKIN_API int coarsest_level_served(int border, int size);

}  // namespace welkin
