#pragma once

#include "welkin/image/texel_walk.h"
#include "welkin/map_file/layout.h"

namespace welkin {

/// How a chart of that size lies in the picture of its cell.
TexelWalk walk_of(const LayoutCell& cell, ChartSize chart);

}  // namespace welkin
