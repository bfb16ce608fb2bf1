#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "welkin/io/image_file.h"

namespace welkin::io {

/// Linear floats → stored pixels, counting what is lost.
///
/// Integers are rounded to nearest: round(largest·x), or round(largest·linear_to_srgb(x)) where encoded.
/// Values above the type's largest are clipped to it and negative ones of integers to 0; infinities of
/// integers likewise, and NaN becomes 0. Half keeps infinities and NaN; finite values beyond ±65504 are
/// clipped.
class PixelEncoder {
 public:
  /// Any type but the packed ones. Stored channel k holds the image's channel order[k], sRGB encoded where
  /// srgb[k]. One that is stored more than once (grey as R G B) is counted once. Where `alpha` is a channel
  /// of the image, those that stand before it in `order` are divided by it first: images have associated
  /// alpha, these files straight one. What has no alpha but shines keeps its colour.
  PixelEncoder(PixelType type, std::vector<int> order, std::vector<bool> srgb, std::optional<int> alpha = {});

  std::size_t pixel_bytes() const;

  /// Encodes `count` pixels of `image_channels` values at `in` into native byte order at `stored`, of any
  /// alignment.
  void encode(const float* in, int image_channels, int count, std::byte* stored, WriteReport& report) const;

  /// Rows of `image` in parallel; stored rows are `stride` bytes apart.
  WriteReport encode_rows(ImageView<const float> image, std::byte* stored, std::size_t stride) const;

 private:
  void encode_as_they_are(const float* in, int image_channels, int count, std::byte* stored,
                          WriteReport& report) const;

  PixelType type_;
  std::vector<int> order_;
  std::vector<bool> srgb_;
  std::optional<int> alpha_;
};

}  // namespace welkin::io
