#pragma once

#include <cassert>
#include <cstddef>
#include <type_traits>

#include "welkin/base/export.h"
#include "welkin/base/large_memory.h"

namespace welkin {

/// A window onto pixels that somebody else owns: rows of `width` texels of `channels` interleaved values, v
/// down, origin top-left. `row_stride` counts values (not bytes) from one row to the next, so a view can be a
/// part of a larger image.
template <class T>
struct ImageView {
  T* data = nullptr;
  int width = 0;
  int height = 0;
  int channels = 0;
  std::ptrdiff_t row_stride = 0;

  T* row(int y) const { return data + y * row_stride; }
  T* at(int x, int y) const { return row(y) + static_cast<std::ptrdiff_t>(x) * channels; }

  /// The rectangle of `w`×`h` texels whose first texel is (x, y).
  ImageView part(int x, int y, int w, int h) const { return {at(x, y), w, h, channels, row_stride}; }

  operator ImageView<const T>() const requires(!std::is_const_v<T>) {
    return {data, width, height, channels, row_stride};
  }
};

/// What new pixels hold: zero, or whatever is there, for those who write all of them.
using PixelContents = LargeMemory::Contents;

/// Pixels of 32-bit float that are owned here. Knows no sphere.
///
/// The buffer starts on a 64-byte boundary and has at least 64 readable bytes after the last value, so that a
/// SIMD load may run past a row's end.
class WELKIN_API Image {
 public:
  Image() = default;

  /// Throws Error when the size is negative or overflows, std::bad_alloc when there is no memory.
  Image(int width, int height, int channels, PixelContents contents = PixelContents::zero);

  int width() const { return view_.width; }
  int height() const { return view_.height; }
  int channels() const { return view_.channels; }
  bool empty() const { return view_.data == nullptr; }

  ImageView<float> view() { return view_; }
  ImageView<const float> view() const { return view_; }
  float* at(int x, int y) { return view_.at(x, y); }
  const float* at(int x, int y) const { return view_.at(x, y); }

 private:
  LargeMemory values_;
  ImageView<float> view_;
};

/// Copies texels between views of one size and one channel count.
WELKIN_API void copy_pixels(ImageView<const float> from, ImageView<float> to);

}  // namespace welkin
