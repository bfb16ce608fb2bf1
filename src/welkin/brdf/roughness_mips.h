#pragma once

#include <vector>

#include "welkin/base/export.h"
#include "welkin/image/image.h"

/// @file
/// Roughness maps whose levels keep what a normal map's levels lose.
namespace welkin::brdf {

/// How levels of roughness are made.
struct RoughnessMipsOptions {
  double normal_scale = 1;  ///< of the normals' x and y, as materials have it
  bool flip_green = false;  ///< y of the normal map goes down (DirectX)
  int levels = 0;           ///< 0: as many as there are down to one texel
};

/// The levels of a roughness map, 1 channel of 0 … 1, the first of the normal map's size: where normals vary
/// within a texel of a level, the surface seen there is as rough as both together. Slopes' variances add
/// (Olano & Baker 2010, LEAN mapping): α² = mean of α² + variance of slopes along x + along y, α =
/// roughness², averaged over both axes; roughness at most 1.
///
/// `normals`: 3 channels, n = 2·value − 1 in the frame of tangents, of any length over 0; those that point
/// below 3° above the surface count as 3° above it. `roughness`: its first channel; of the same size, or one
/// texel for all. Throws Error: (mismatch) other sizes, (bad_request) fewer channels, options out of range,
/// (bad_value) values that are not finite, roughness outside 0 … 1, a normal of length 0.
WELKIN_API std::vector<Image> roughness_mips(ImageView<const float> normals, ImageView<const float> roughness,
                                             const RoughnessMipsOptions& options = {});

}  // namespace welkin::brdf
