#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

/// rgb9e5: mantissas of 9 bits (R lowest) and an exponent of 5 bits (highest) in 32 bits. Source: OpenGL
/// extension EXT_texture_shared_exponent, section 2.25.
///
///     value = mantissa · 2^(exponent − 24)
namespace welkin::io {

/// 511·2^7.
inline constexpr float kLargestSharedExponent = 65408;

/// The pixel of three values in [0, kLargestSharedExponent]. The exponent is the least that holds the largest
/// of them, and mantissas are ⌊value·2^(24−exponent) + ½⌋, as the extension demands. Without branches, so
/// that loops over arrays become SIMD.
inline std::uint32_t shared_exponent_of(float r, float g, float b) {
  // ⌊x + ½⌋ for x in [0, 512); the sum x + ½ itself would round.
  const auto rounded = [](float x) {
    const auto whole = static_cast<std::int32_t>(x);
    return whole + (x - static_cast<float>(whole) >= 0.5f ? 1 : 0);
  };
  // 2^(24−exponent), the exponent being that of the format.
  const auto scale_for = [](std::int32_t exponent) {
    return std::bit_cast<float>(static_cast<std::uint32_t>(127 + 24 - exponent) << 23);
  };
  const float largest = std::max(r, std::max(g, b));
  // max(−16, ⌊log2 largest⌋) + 16, by the exponent of the float.
  const std::int32_t floor_log2 =
      static_cast<std::int32_t>(std::bit_cast<std::uint32_t>(largest) >> 23) - 127;
  const std::int32_t minimum = (floor_log2 > -16 ? floor_log2 : -16) + 16;
  const std::int32_t exponent = minimum + (rounded(largest * scale_for(minimum)) == 512 ? 1 : 0);
  const float scale = scale_for(exponent);
  return static_cast<std::uint32_t>(exponent << 27 | rounded(b * scale) << 18 | rounded(g * scale) << 9 |
                                    rounded(r * scale));
}

/// The three values of a pixel; exact.
inline void values_of_shared_exponent(std::uint32_t stored, float* rgb) {
  const float scale = std::bit_cast<float>((127 - 24 + (stored >> 27)) << 23);
  for (int k = 0; k < 3; ++k) rgb[k] = static_cast<float>(stored >> (9 * k) & 511) * scale;
}

}  // namespace welkin::io
