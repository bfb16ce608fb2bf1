#pragma once

#include <cassert>
#include <cstddef>
#include <type_traits>

#include "welkin/base/export.h"
#include "welkin/base/large_memory.h"

/// @file
/// Pixels in memory.
namespace welkin {

/// A window onto pixels that something else owns, which must outlive it: rows of `width` texels of `channels`
/// interleaved values, v down, origin top-left. A view can be a part of a larger image. T is float or const
/// float. Nothing checks indices.
template <class T>
struct ImageView {
  T* data = nullptr;              ///< the first value of the top left texel
  int width = 0;                  ///< texels in a row
  int height = 0;                 ///< rows
  int channels = 0;               ///< values of a texel
  std::ptrdiff_t row_stride = 0;  ///< values (not bytes) from one row to the next

  /// The first value of row y.
  T* row(int y) const { return data + y * row_stride; }
  /// The first value of texel x of row y.
  T* at(int x, int y) const { return row(y) + static_cast<std::ptrdiff_t>(x) * channels; }

  /// The rectangle of `w`×`h` texels whose first texel is (x, y).
  ImageView part(int x, int y, int w, int h) const { return {at(x, y), w, h, channels, row_stride}; }

  /// A view to read from.
  operator ImageView<const T>() const requires(!std::is_const_v<T>) {
    return {data, width, height, channels, row_stride};
  }
};

/// What new pixels hold: zero, or unspecified values, for those who write all of them.
using PixelContents = LargeMemory::Contents;

/// Pixels of 32-bit float that are owned here. Knows no sphere.
///
/// The buffer starts on a 64-byte boundary and has at least 64 readable bytes after the last value, so that a
/// SIMD load may run past a row's end. Moved, not copied (copy_pixels).
class WELKIN_API Image {
 public:
  /// No pixels.
  Image() = default;

  /// Throws Error (bad_request) when a size is below 1, (too_large) when their product overflows;
  /// std::bad_alloc when there is no memory.
  Image(int width, int height, int channels, PixelContents contents = PixelContents::zero);

  int width() const { return view_.width; }             ///< texels in a row
  int height() const { return view_.height; }           ///< rows
  int channels() const { return view_.channels; }       ///< values of a texel
  bool empty() const { return view_.data == nullptr; }  ///< whether there are no pixels

  /// All pixels; valid as long as the image is, and where it is moved to.
  /// @{
  ImageView<float> view() { return view_; }
  ImageView<const float> view() const { return view_; }
  /// @}

  /// The first value of texel x of row y. Nothing checks indices.
  /// @{
  float* at(int x, int y) { return view_.at(x, y); }
  const float* at(int x, int y) const { return view_.at(x, y); }
  /// @}

 private:
  LargeMemory values_;
  ImageView<float> view_;
};

/// Copies texels between views of one size and one number of channels, which do not overlap. Throws Error
/// (bad_request) when they differ.
WELKIN_API void copy_pixels(ImageView<const float> from, ImageView<float> to);

}  // namespace welkin
