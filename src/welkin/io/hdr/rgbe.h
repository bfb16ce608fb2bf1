#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

/// The pixel of Radiance pictures: three 8-bit mantissas and one shared exponent (Ward 1991, "Real Pixels",
/// Graphics Gems II).
///
///     value = mantissa · 2^(exponent − 136),   exponent 0: black
///
/// Radiance's own reader adds ½ to the mantissa, the centre of the interval if the writer truncates. Here
/// writing rounds to nearest, so the stored value is already the centre; adding ½ would brighten every image,
/// turn a black component of a lit pixel into light, and make reading and writing again drift. The result is
/// exact in float.
namespace welkin::io {

/// The largest value: mantissa 255, exponent 255.
inline constexpr float kLargestRgbe = 255 * 0x1p119f;

/// `count` pixels from four planes to interleaved R G B.
inline void decode_rgbe(const std::uint8_t* r, const std::uint8_t* g, const std::uint8_t* b,
                        const std::uint8_t* e, int count, float* rgb) {
  for (int i = 0; i < count; ++i) {
    // 2^(e − 136) can be below the normal floats, so it is the product of two powers that never are; each is
    // made by placing its biased exponent. For e = 0 the first is 0.
    const std::uint32_t exponent = e[i];
    const std::uint32_t half = exponent >> 1;
    const std::uint32_t lit = exponent != 0 ? ~0u : 0u;
    const float first = std::bit_cast<float>(((half + 64) << 23) & lit);      // 2^(half − 63)
    const float second = std::bit_cast<float>((exponent - half + 54) << 23);  // 2^(e − half − 73)
    rgb[3 * i + 0] = static_cast<float>(r[i]) * first * second;
    rgb[3 * i + 1] = static_cast<float>(g[i]) * first * second;
    rgb[3 * i + 2] = static_cast<float>(b[i]) * first * second;
  }
}

/// The nearest pixel to three values in [0, kLargestRgbe], its largest mantissa in [128, 255]; black below
/// 2^-128, the smallest that can be stored so.
inline void encode_rgbe(float r, float g, float b, std::uint8_t pixel[4]) {
  const float largest = std::fmax(r, std::fmax(g, b));
  if (largest < 0x1p-128f) {
    std::memset(pixel, 0, 4);
    return;
  }
  // largest = f·2^exponent, f in [½, 1).
  int exponent = static_cast<int>(std::bit_cast<std::uint32_t>(largest) >> 23) - 126;
  if (largest < 0x1p-126f) std::frexp(largest, &exponent);
  const auto scale = [&] {
    return std::bit_cast<double>(static_cast<std::uint64_t>(1023 + 8 - exponent) << 52);
  };
  if (largest * scale() >= 255.5) ++exponent;
  const double by = scale();
  pixel[0] = static_cast<std::uint8_t>(r * by + 0.5);
  pixel[1] = static_cast<std::uint8_t>(g * by + 0.5);
  pixel[2] = static_cast<std::uint8_t>(b * by + 0.5);
  pixel[3] = static_cast<std::uint8_t>(exponent + 128);
}

}  // namespace welkin::io
