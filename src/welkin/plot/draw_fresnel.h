#pragma once

#include <span>

#include "welkin/base/export.h"
#include "welkin/brdf/fresnel.h"
#include "welkin/image/image.h"

/// @file
/// Pictures of reflectance by angle.
namespace welkin {

/// Curves of the boundaries' reflectance, 0 … 1, against the angle of incidence, 0 … 90°, on white, linear
/// sRGB. They are numbered from 1 in the order given, from dark violet to green, in the list at the right.
/// `width` is the picture's, pixels, 200 … 4096. Throws Error (bad_request) for another width and for what
/// brdf::check says.
WELKIN_API Image draw_fresnel(std::span<const brdf::Boundary> boundaries, int width = 720);

}  // namespace welkin
