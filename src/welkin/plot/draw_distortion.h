#pragma once

#include "welkin/base/export.h"
#include "welkin/image/image.h"

/// @file
/// Pictures of what paraboloid maps do to circles.
namespace welkin {

/// circle_distortion (prefilter/paraboloid_convolution.h) against the distance of a circle's centre from a
/// face's, 0 … 1, as curves for circles of radius 0.1, 0.2 … 0.5, on white, linear sRGB; the vertical axis
/// ends at 25 %. After Kautz et al. 2000, fig. 12. The picture is `width` pixels wide, at least 200: Error
/// (bad_request).
WELKIN_API Image draw_circle_distortion(int width);

}  // namespace welkin
