#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "welkin/io/capabilities.h"

namespace welkin::io {

/// How the bits of a sample are a number.
struct TiffSamples {
  enum class Kind { unsigned_integer, signed_integer, floating };
  Kind kind = Kind::unsigned_integer;
  int bits = 8;

  /// `12-bit unsigned integers`.
  std::string name() const;
  /// The type that holds their values: signed integers and odd floats as float, others as the next wider
  /// integer.
  PixelType type() const;
  /// Whether they lie in memory as values of type(), for PixelDecoder.
  bool plain() const;
};

/// Those of TIFF's BitsPerSample and SampleFormat; nothing for what is not read: 64-bit integers, complex
/// numbers, floats of other than 16, 24, 32 and 64 bits.
std::optional<TiffSamples> tiff_samples(int bits, int format);

/// What they are called that tiff_samples doesn't know.
std::string name_of_tiff_samples(int bits, int format);

/// `count` samples of a row as libtiff hands it over, to floats. Unsigned integers of n bits become k/(2^n −
/// 1), and every `inverted_step`-th of them, from the first on, 1 minus that (0 is white; no step: none of
/// them); signed ones k/(2^(n−1) − 1), negative values kept; 64-bit floats the nearest ones. Integers of 8,
/// 16, 24 and 32 bits and all floats are in native byte order, others are packed from the most significant
/// bit on.
void unpack_tiff_samples(const TiffSamples& samples, std::size_t inverted_step, const std::byte* row,
                         std::size_t count, float* values);

}  // namespace welkin::io
