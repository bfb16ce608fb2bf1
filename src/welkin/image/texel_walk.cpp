#include "welkin/image/texel_walk.h"

#include <algorithm>
#include <cassert>

namespace welkin {
namespace {

/// Copies `count` texels, each `from_step` values after the one before, to every `to_step`-th value.
template <int kChannels>
void copy_texels(const float* from, std::ptrdiff_t from_step, float* to, std::ptrdiff_t to_step, int count) {
  // Value by value: as copy_n each texel would be a call of memmove.
  for (int x = 0; x < count; ++x, from += from_step, to += to_step) {
    for (int c = 0; c < kChannels; ++c) to[c] = from[c];
  }
}

void copy_texels(const float* from, std::ptrdiff_t from_step, float* to, std::ptrdiff_t to_step, int count,
                 int channels) {
  if (from_step == channels && to_step == channels) {
    std::copy_n(from, static_cast<std::ptrdiff_t>(count) * channels, to);
  } else if (channels == 1) {
    copy_texels<1>(from, from_step, to, to_step, count);
  } else if (channels == 3) {
    copy_texels<3>(from, from_step, to, to_step, count);
  } else if (channels == 4) {
    copy_texels<4>(from, from_step, to, to_step, count);
  } else {
    for (int x = 0; x < count; ++x, from += from_step, to += to_step) std::copy_n(from, channels, to);
  }
}

/// Values of the image from one texel of the picture to the one on its right.
template <class T>
std::ptrdiff_t step_right(const ImageView<T>& image, const TexelWalk& walk) {
  return walk.right_x * static_cast<std::ptrdiff_t>(image.channels) + walk.right_y * image.row_stride;
}

template <class T>
T* row_start(const ImageView<T>& image, const TexelWalk& walk, int y) {
  return image.at(walk.image_x(0, y), walk.image_y(0, y));
}

}  // namespace

TexelRectangle texels_of(const TexelWalk& walk, int width, int height) {
  const int right = walk.image_x(width - 1, height - 1), bottom = walk.image_y(width - 1, height - 1);
  const int x = std::min(walk.start_x, right), y = std::min(walk.start_y, bottom);
  return {x, y, std::max(walk.start_x, right) - x + 1, std::max(walk.start_y, bottom) - y + 1};
}

void copy_walked(ImageView<const float> image, const TexelWalk& walk, ImageView<float> picture) {
  assert(image.channels == picture.channels);
  for (int y = 0; y < picture.height; ++y) {
    copy_texels(row_start(image, walk, y), step_right(image, walk), picture.row(y), picture.channels,
                picture.width, picture.channels);
  }
}

void copy_unwalked(ImageView<const float> picture, const TexelWalk& walk, ImageView<float> image) {
  assert(image.channels == picture.channels);
  for (int y = 0; y < picture.height; ++y) {
    copy_texels(picture.row(y), picture.channels, row_start(image, walk, y), step_right(image, walk),
                picture.width, picture.channels);
  }
}

}  // namespace welkin
