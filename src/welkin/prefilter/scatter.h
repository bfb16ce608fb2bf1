#pragma once

#include "welkin/base/monitor.h"
#include "welkin/prefilter/moments.h"

namespace welkin::prefilter {

/// The masses of any map on the grid of `moments`, texel by texel: points of each texel (texel_points.h),
/// spread over 6×6 grid points by Lagrange interpolation of degree five. The same sums whatever the number of
/// threads. Throws Cancelled.
void scatter_texels(const Map& map, Moments& moments, const Monitor& monitor);

}  // namespace welkin::prefilter
