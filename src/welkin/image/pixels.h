#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "welkin/base/export.h"
#include "welkin/image/image.h"

/// @file
/// Pixels of other programs: any spacing, float or half.
namespace welkin {

/// How one value is stored.
enum class PixelFormat {
  float32,  ///< IEEE 754 binary32, four bytes
  half,     ///< IEEE 754 binary16, two bytes
};

/// Where a rectangle of pixels lies in memory: rows from the top down, texels from left to right, the values
/// of a texel one after the other. Values are linear radiance. `Bytes` is const std::byte or std::byte.
template <class Bytes>
struct BasicPixels {
  Bytes* data = nullptr;                      ///< the first value of the top left texel
  int width = 0;                              ///< texels in a row
  int height = 0;                             ///< rows
  int channels = 0;                           ///< values of a texel
  PixelFormat format = PixelFormat::float32;  ///< of each value, in the order of bytes of this processor
  /// Bytes from one texel to the next; 0: there is nothing between them.
  std::ptrdiff_t texel_bytes = 0;
  /// Bytes from one row to the next, negative for rows stored from the bottom up; 0: nothing between them.
  std::ptrdiff_t row_bytes = 0;

  /// The same pixels, to read from.
  operator BasicPixels<const std::byte>() const requires(!std::is_const_v<Bytes>) {
    return {data, width, height, channels, format, texel_bytes, row_bytes};
  }
};
/// Pixels to read from; they must last until the call that takes them returns.
using Pixels = BasicPixels<const std::byte>;
/// Pixels to write to.
using MutablePixels = BasicPixels<std::byte>;

/// Packed floats, or halves by their bits, as Pixels: nothing between texels and rows, top row first.
/// @{
inline Pixels pixels_of(const float* data, int width, int height, int channels) {
  return {reinterpret_cast<const std::byte*>(data), width, height, channels, PixelFormat::float32, 0, 0};
}
inline Pixels pixels_of(const std::uint16_t* half, int width, int height, int channels) {
  return {reinterpret_cast<const std::byte*>(half), width, height, channels, PixelFormat::half, 0, 0};
}
inline MutablePixels pixels_of(float* data, int width, int height, int channels) {
  return {reinterpret_cast<std::byte*>(data), width, height, channels, PixelFormat::float32, 0, 0};
}
inline MutablePixels pixels_of(std::uint16_t* half, int width, int height, int channels) {
  return {reinterpret_cast<std::byte*>(half), width, height, channels, PixelFormat::half, 0, 0};
}
/// @}

/// Copies pixels of any spacing into packed floats; the two don't overlap. NaN and infinity stay. Throws
/// Error: (mismatch) other sizes or numbers of channels, (bad_request) no data, or values that would overlap.
WELKIN_API void copy_pixels(const Pixels& from, ImageView<float> to);
/// The reverse. Halves are rounded to nearest, and become infinite above 65504.
WELKIN_API void copy_pixels(ImageView<const float> from, const MutablePixels& to);

}  // namespace welkin
