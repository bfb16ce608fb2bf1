#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "welkin/io/image_file.h"

/// VkFormats, by which KTX2 names the type of its texels. Source: the Vulkan specification, "Formats".
namespace welkin::io::texels {

/// How the bits of a texel are its values.
enum class Coding {
  plain,    ///< values of TexelFormat::type, one behind the other
  snorm,    ///< signed integers of one or two bytes: −1…1
  doubles,  ///< 64-bit floats
  fields,   ///< integers of a few bits, in one word
  packed,   ///< rgb9e5 or r11g11b10
  blocks,   ///< bc6h, uastc_hdr or astc_hdr, 4×4 texels at a time
};

/// A format whose texels are read.
struct TexelFormat {
  std::uint32_t number;
  PixelType type;             ///< that holds its values
  std::string_view channels;  ///< in the order in which they are decoded: `RGBA`, `BGR`…
  bool srgb;
  Coding coding = Coding::plain;
  /// Bytes of what is swapped between byte orders: one value, or the whole of a packed texel.
  std::uint32_t type_size = 1;
  /// Of Coding::fields: from the most significant bit, the name and the number of bits of each,
  /// `A2R10G10B10`.
  std::string_view fields = {};
  bool is_signed = false;  ///< of Coding::fields and Coding::blocks

  bool packed() const { return is_packed(type); }
  /// Texels along a side of what is stored together.
  int block() const { return coding == Coding::blocks ? 4 : 1; }
  /// Whether PixelDecoder decodes its texels as they lie in the file; decode_values makes floats of others.
  bool plain() const { return coding == Coding::plain; }
  /// Bytes of a texel, or of a block.
  std::size_t bytes() const {
    if (coding == Coding::blocks) return 16;
    const bool one_word = coding == Coding::packed || coding == Coding::fields;
    return one_word ? type_size : channels.size() * type_size;
  }
};

/// KTX2's number of the colour model of UASTC HDR 4×4: what tells it from other ASTC HDR, whose VkFormat it
/// has.
inline constexpr std::uint32_t kModelUastcHdr = 167;

/// Null when texels of that format are not read. `colour_model` is KTX2's, 0 in other files.
const TexelFormat* find_format(std::uint32_t number, std::uint32_t colour_model = 0);

/// The format that pixels of a type are written in: float32 and half with alpha, rgb9e5, r11g11b10, bc6h,
/// uastc_hdr; or float32 and half of two channels, R and G.
const TexelFormat& format_for(PixelType type, bool two_channels = false);

}  // namespace welkin::io::texels
