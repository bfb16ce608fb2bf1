#pragma once

#include <array>

namespace welkin {

/// The colour of t ∈ [0, 1] on a scale from dark violet over blue and green to light yellow, linear sRGB in
/// [0, 1]. Lightness rises evenly, so the order reads in grey too and to colour-blind eyes. t outside is
/// clamped, NaN gives t = 0. An arc through the Oklab colour space (B. Ottosson, "A perceptual color space
/// for image processing", 2020).
std::array<float, 3> color_ramp(double t);

/// Where a picture has nothing to show: a grey of middle lightness.
std::array<float, 3> neutral_color();

}  // namespace welkin
