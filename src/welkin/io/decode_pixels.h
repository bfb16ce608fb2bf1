#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "welkin/io/image_file.h"

namespace welkin::io {

/// Stored pixels → linear floats. Integers become k/largest or their sRGB linear value, by table, each the
/// correctly rounded one (uint32: within 1 ulp); half and float are kept bit for bit, or made linear if they
/// are said to be sRGB.
class PixelDecoder {
 public:
  /// Any type but the packed ones. `srgb` says of each stored channel whether it is sRGB encoded; there are
  /// srgb.size() values per pixel.
  PixelDecoder(PixelType type, std::vector<bool> srgb);

  /// Decodes `count` interleaved pixels at `stored` (native byte order, any alignment). Stored channel
  /// channels[k] of pixel i goes to out[i·step + k].
  void decode(const void* stored, std::span<const int> channels, int count, float* out,
              std::ptrdiff_t step) const;

  /// All rows of `out`, in parallel; stored rows are `stride` bytes apart.
  void decode_rows(const std::byte* stored, std::size_t stride, std::span<const int> channels,
                   ImageView<float> out) const;

 private:
  PixelType type_;
  std::vector<char> srgb_;
  bool all_linear_;
  std::vector<const float*> tables_;  ///< uint8 and uint16: one per stored channel
};

/// Bytes of one stored value; of none that is packed with others.
std::size_t size_of(PixelType type);

/// For each of `names` whether it is sRGB encoded when the colour of its file is `colour`: alpha (`A`) never
/// is.
std::vector<bool> srgb_channels(std::span<const std::string> names, Colour colour);

}  // namespace welkin::io
