#pragma once

#include <cstddef>
#include <cstdint>

/// Rows of texels of four halves ↔ rows of floats, by the processor's own conversion (F16C) where it has one.
/// Internal to io.
namespace welkin::io::texels {

/// `count` texels of R G B (A) to four halves each, at any alignment; A is 1 where there is none. Values over
/// 65504 become that and are counted in `above`; infinity stays.
using EncodeHalfTexels = void (*)(const float* in, int channels, int count, std::byte* out,
                                  std::uint64_t& above);

/// `count` texels of four halves to R G B (A).
using DecodeHalfTexels = void (*)(const std::byte* in, int count, float* out, int channels);

/// For this processor, or null where it has no such instructions: the same results as small_float.h, but for
/// the payload of signalling NaN.
/// @{
EncodeHalfTexels encode_half_texels();
DecodeHalfTexels decode_half_texels();
/// @}

}  // namespace welkin::io::texels
