#pragma once

#include "welkin/base/parallel.h"
#include "welkin/prefilter/moments.h"

namespace welkin::prefilter {

/// The masses of any map on the grid of `moments`, texel by texel: points of Gauss's rule in each texel,
/// spread over 4×4 grid points by cubic Lagrange interpolation. The same sums whatever the number of threads.
/// Throws Cancelled.
void scatter_texels(const Map& map, Moments& moments, const Monitor& monitor);

}  // namespace welkin::prefilter
