#include "welkin/image/image.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <new>

#include "welkin/base/error.h"
#include "welkin/base/large_memory.h"

namespace welkin {
namespace {

constexpr std::size_t kAlignment = 64;
constexpr std::size_t kReadablePastEnd = 64;

}  // namespace

void Image::Free::operator()(float* p) const {
  std::free(p);
}

Image::Image(int width, int height, int channels) {
  if (width <= 0 || height <= 0 || channels <= 0) {
    throw Error(ErrorKind::bad_request, "an image of " + std::to_string(width) + "×" +
                                            std::to_string(height) + " texels and " +
                                            std::to_string(channels) + " channels cannot be made");
  }
  const std::uint64_t most = std::numeric_limits<std::ptrdiff_t>::max() / sizeof(float) / 2;
  const std::uint64_t texels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  if (texels > most / static_cast<std::uint64_t>(channels))
    throw Error(ErrorKind::too_large, "image size overflows");
  const std::size_t values = static_cast<std::size_t>(texels) * static_cast<std::size_t>(channels);
  // calloc hands out fresh pages without touching them, so a large image costs nothing until it is written.
  const std::size_t bytes = values * sizeof(float) + kReadablePastEnd + kAlignment;
  float* base = static_cast<float*>(std::calloc(bytes, 1));
  if (base == nullptr) throw std::bad_alloc();
  values_.reset(base);
  prefer_large_pages(base, bytes);
  const auto address = reinterpret_cast<std::uintptr_t>(base);
  const std::size_t skip = (kAlignment - address % kAlignment) % kAlignment;
  view_ = {base + skip / sizeof(float), width, height, channels,
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
