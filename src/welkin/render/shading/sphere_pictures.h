#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/image/image.h"

/// @file
/// Pictures of a sphere that shade without light: sketches (Heidrich & Seidel 1999, fig. 15).
namespace welkin::scene {

/// Names of the built-in ones: `window`, `cool-warm`, `outline`, `hatching`.
WELKIN_API std::vector<std::string> sphere_picture_names();

/// A picture of a sphere, R G B, of `size` texels a side; its disc fills the square, and what is outside goes
/// on as the rim does. Its levels below it are made for it, as many as there are down to one texel: those of
/// `outline` have a black rim of as many texels in every level, so that an outline is as wide on the screen
/// whatever the curvature; those of the others are means of the one before. Throws Error (bad_request): an
/// unknown name, a size outside 8 … 8192.
WELKIN_API std::vector<Image> sphere_picture(std::string_view name, int size = 512);

}  // namespace welkin::scene
