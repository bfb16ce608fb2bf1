#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "welkin/io/texels/formats.h"
#include "welkin/io/texels/half_texels.h"

/// Rows of linear floats ↔ rows of texels as KTX2 stores them, tightly packed.
namespace welkin::io::texels {

/// Encodes rows in the formats of format_for. Grey becomes three equal values; alpha is 1 where there is
/// none.
///
/// Float keeps every value. Half keeps infinities and NaN; finite values beyond ±65504 are clipped (`above`).
/// r11g11b10 keeps +infinity and NaN, and clips at 65024 (R, G) and 64512 (B); rgb9e5 clips at 65408. In both
/// negative values become 0 (`below`). rgb9e5 stores infinity as its largest value, NaN as 0 (`not_finite`);
/// bc6h and uastc_hdr are lossy, clip at 65504, infinity too, and store NaN as 0.
/// Rounding is to nearest, in rgb9e5 as its extension demands.
class TexelEncoder {
 public:
  /// `order` as channel_order gives it: Y, Y A, R G B or R G B A; no A for packed types. `colour` is linear
  /// or srgb, in which colour values are encoded before they are stored. With `two_channels`, order says
  /// which channels are R and G, and texels hold these alone.
  TexelEncoder(PixelType type, std::vector<int> order, Colour colour, bool two_channels = false,
               TextureQuality quality = TextureQuality::normal);

  /// `count` texels of `channels` values at `in`, to `out`, of any alignment. Not of blocks.
  void encode(const float* in, int channels, int count, std::byte* out, WriteReport& report) const;
  /// A row of texels, or the rows of a row of blocks, to its bytes.
  void encode(ImageView<const float> rows, std::span<std::byte> out, WriteReport& report) const;

 private:
  void encode_two(const float* in, int channels, int count, std::byte* out, WriteReport& report) const;
  void encode_blocks(ImageView<const float> rows, std::span<std::byte> out, WriteReport& report) const;

  PixelType type_;
  std::size_t texel_bytes_;
  std::vector<int> order_;
  bool srgb_;
  bool two_channels_;
  TextureQuality quality_;
  bool copies_;                               ///< floats in the order of the file
  EncodeHalfTexels encode_halves_ = nullptr;  ///< of halves in the order of the file, where there is one
};

/// `count` texels of a packed type to interleaved R G B; exact.
void decode_packed(PixelType type, const std::byte* stored, int count, float* rgb);

/// `count` texels of a format that isn't plain to floats, TexelFormat::channels interleaved. Integers of n
/// bits become k/(2^n − 1), signed ones max(−1, k/(2^(n−1) − 1)), as the Vulkan specification defines them;
/// doubles the nearest floats. Not of blocks.
void decode_values(const TexelFormat& format, const std::byte* stored, int count, float* values);

}  // namespace welkin::io::texels
