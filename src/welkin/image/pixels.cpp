#include "welkin/image/pixels.h"

#include <Imath/half.h>

#include <cstring>

#include "welkin/base/error.h"

namespace welkin {
namespace {

/// Strides in bytes, those that were left out filled in.
struct Strides {
  std::ptrdiff_t value, texel, row;
};

template <class Bytes>
Strides strides_of(const BasicPixels<Bytes>& pixels, int width, int height, int channels) {
  require(pixels.data != nullptr, "pixels to copy have no data");
  if (pixels.width != width || pixels.height != height || pixels.channels != channels)
    throw Error(ErrorKind::mismatch,
                "pixels of another program have another size or number of channels than the map's");
  const std::ptrdiff_t value = pixels.format == PixelFormat::half ? 2 : 4;
  const std::ptrdiff_t texel = pixels.texel_bytes == 0 ? value * channels : pixels.texel_bytes;
  const std::ptrdiff_t row = pixels.row_bytes == 0 ? texel * width : pixels.row_bytes;
  require(texel >= value * channels, "the texels of pixels to copy overlap");
  require((row < 0 ? -row : row) >= texel * (width - 1) + value * channels,
          "the rows of pixels to copy overlap");
  return {value, texel, row};
}

/// convert(bytes, value) for every value.
template <class Bytes, class View, class Convert>
void for_each_value(const BasicPixels<Bytes>& pixels, const View& view, const Convert& convert) {
  const Strides strides = strides_of(pixels, view.width, view.height, view.channels);
  for (int y = 0; y < view.height; ++y) {
    auto* value = view.row(y);
    Bytes* texel = pixels.data + y * strides.row;
    for (int x = 0; x < view.width; ++x, texel += strides.texel) {
      for (int c = 0; c < view.channels; ++c) convert(texel + c * strides.value, *value++);
    }
  }
}

}  // namespace

void copy_pixels(const Pixels& from, ImageView<float> to) {
  if (from.format == PixelFormat::half) {
    for_each_value(from, to, [](const std::byte* bytes, float& value) {
      std::uint16_t bits;
      std::memcpy(&bits, bytes, sizeof bits);
      value = imath_half_to_float(bits);
    });
  } else {
    for_each_value(from, to,
                   [](const std::byte* bytes, float& value) { std::memcpy(&value, bytes, sizeof value); });
  }
}

void copy_pixels(ImageView<const float> from, const MutablePixels& to) {
  if (to.format == PixelFormat::half) {
    for_each_value(to, from, [](std::byte* bytes, float value) {
      const std::uint16_t bits = imath_float_to_half(value);
      std::memcpy(bytes, &bits, sizeof bits);
    });
  } else {
    for_each_value(to, from, [](std::byte* bytes, float value) { std::memcpy(bytes, &value, sizeof value); });
  }
}

}  // namespace welkin
