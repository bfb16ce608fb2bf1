#pragma once

#include "welkin/base/export.h"

/// @file
/// Which number a texel of a table stands for.
namespace welkin::brdf {

/// Where a table's texels lie on its axis from 0 to 1.
enum class TexelPlacement {
  centres,  ///< texel i of n at (i + ½)/n: read with the coordinate as it is
  ends,  ///< texel i of n at i/(n − 1): read with the coordinate moved to texel centres, (u (n − 1) + ½)/n
};

/// The coordinate of texel `i` of `count`. Of a single texel it is ½ either way. Throws Error (bad_request)
/// for an index that the axis doesn't have.
WELKIN_API double texel_coordinate(int i, int count, TexelPlacement placement);

}  // namespace welkin::brdf
