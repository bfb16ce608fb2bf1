#pragma once

#include <cstdint>
#include <span>

/// The sRGB transfer function (IEC 61966-2-1) between stored integers and linear floats.
namespace welkin::io {

/// Linear value of an encoded one in [0, 1]. Exact formula, float64. Outside [0, 1] the same formula
/// continues, odd about 0, as IEC 61966-2-2 (scRGB) extends it.
double srgb_to_linear(double encoded);
/// Encoded value of a linear one in [0, 1]; outside likewise.
double linear_to_srgb(double linear);

/// The 256 linear values of sRGB bytes, and the 65536 of 16-bit words; made at first use.
std::span<const float> srgb8_to_linear();
std::span<const float> srgb16_to_linear();

/// The 256 values k/255, and the 65536 values k/65535.
std::span<const float> unorm8_to_float();
std::span<const float> unorm16_to_float();

}  // namespace welkin::io
