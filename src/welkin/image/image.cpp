#include "welkin/image/image.h"

#include <algorithm>
#include <cstdint>
#include <limits>

#include "welkin/base/error.h"

namespace welkin {
namespace {

constexpr std::size_t kReadablePastEnd = 64;

}  // namespace

Image::Image(int width, int height, int channels, PixelContents contents) {
  if (width <= 0 || height <= 0 || channels <= 0) {
    throw Error(ErrorKind::bad_request, "an image of " + std::to_string(width) + "×" +
                                            std::to_string(height) + " texels and " +
                                            std::to_string(channels) + " channels cannot be made");
  }
  const std::uint64_t maximum = std::numeric_limits<std::ptrdiff_t>::max() / sizeof(float) / 2;
  const std::uint64_t texels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  if (texels > maximum / static_cast<std::uint64_t>(channels))
    throw Error(ErrorKind::too_large, "image size overflows");
  const std::size_t values = static_cast<std::size_t>(texels) * static_cast<std::size_t>(channels);
  values_ = LargeMemory(values * sizeof(float) + kReadablePastEnd, contents);
  view_ = {reinterpret_cast<float*>(values_.data()), width, height, channels,
           static_cast<std::ptrdiff_t>(width) * channels};
}

void copy_pixels(ImageView<const float> from, ImageView<float> to) {
  require(from.width == to.width && from.height == to.height && from.channels == to.channels,
          "pixels are copied between views of one size and number of channels");
  for (int y = 0; y < from.height; ++y) {
    std::copy_n(from.row(y), static_cast<std::size_t>(from.width) * static_cast<std::size_t>(from.channels),
                to.row(y));
  }
}

}  // namespace welkin
