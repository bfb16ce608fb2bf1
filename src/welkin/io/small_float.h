#pragma once

#include <bit>
#include <cstdint>

/// Floats of a 5-bit exponent and few bits of mantissa: the half (10 bits, and a sign), and the parts of
/// r11g11b10 (6 and 5 bits, never negative). Source: IEEE 754-2008, binary16; Khronos Data Format
/// Specification 1.3, chapter 10.
///
///     exponent 0: mantissa · 2^(−14−bits)    31: infinity, or NaN if the mantissa isn't 0
///     otherwise: (1 + mantissa·2^−bits) · 2^(exponent−15)
///
/// Without branches, so that loops over arrays become SIMD.
namespace welkin::io {

/// The largest finite value: 65504, 65024 and 64512 for 10, 6 and 5 bits.
template <int kMantissaBits>
constexpr float largest_small_float() {
  return 65536.0f - 65536.0f / static_cast<float>(2 << kMantissaBits);
}

/// Rounded to nearest, ties to even. `magnitude` is the bits of a float that is positive: at most
/// largest_small_float, infinity, or a NaN, whose upper bits are kept.
template <int kMantissaBits>
inline std::uint32_t small_float_of(std::uint32_t magnitude) {
  constexpr int kDropped = 23 - kMantissaBits;
  constexpr auto kInfinity = static_cast<std::int32_t>(0x7f800000u);
  constexpr auto kMinNormal = static_cast<std::int32_t>(std::bit_cast<std::uint32_t>(0x1p-14f));
  const auto bits = static_cast<std::int32_t>(magnitude);

  const std::uint32_t to_even = ((1u << (kDropped - 1)) - 1) + (magnitude >> kDropped & 1);
  const std::uint32_t normal = ((magnitude + to_even) >> kDropped) - (112u << kMantissaBits);
  // Beside this power of two, the last place of a float is 2^(−14−bits): the sum rounds to it.
  constexpr float kUnit = std::bit_cast<float>(static_cast<std::uint32_t>(127 + 9 - kMantissaBits) << 23);
  const std::uint32_t subnormal = std::bit_cast<std::uint32_t>(std::bit_cast<float>(magnitude) + kUnit) -
                                  std::bit_cast<std::uint32_t>(kUnit);
  const std::uint32_t kept = (magnitude & 0x7fffffu) >> kDropped;
  const std::uint32_t nan_mark = bits > kInfinity && kept == 0 ? 1 : 0;
  const std::uint32_t special = 31u << kMantissaBits | kept | nan_mark;
  return bits < kMinNormal ? subnormal : bits < kInfinity ? normal : special;
}

/// The value of the lowest 5 + kMantissaBits bits of `stored`; exact.
template <int kMantissaBits>
inline float float_of_small(std::uint32_t stored) {
  const std::uint32_t mantissa = stored & ((1u << kMantissaBits) - 1);
  const std::uint32_t exponent = stored >> kMantissaBits & 31;
  constexpr float kStep = std::bit_cast<float>(static_cast<std::uint32_t>(127 - 14 - kMantissaBits) << 23);
  const std::uint32_t wide = (exponent == 31 ? 255 : exponent + 112) << 23 | mantissa << (23 - kMantissaBits);
  return exponent == 0 ? static_cast<float>(mantissa) * kStep : std::bit_cast<float>(wide);
}

}  // namespace welkin::io
