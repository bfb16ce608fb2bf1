#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "welkin/io/image_file.h"

/// VkFormats, by which KTX2 names the type of its texels. Source: the Vulkan specification, "Formats".
namespace welkin::io::ktx2 {

/// A format whose texels are read. They are `channels` values of one type, or are packed into 32 bits.
struct TexelFormat {
  std::uint32_t number;
  PixelType type;
  std::string_view channels;  ///< in the order in which they are stored: `RGBA`, `BGR`…
  bool srgb;

  bool packed() const { return type == PixelType::rgb9e5 || type == PixelType::r11g11b10; }
  /// Bytes of a texel.
  std::size_t bytes() const;
  /// Bytes of what is swapped between byte orders: the whole of a packed texel, or one value.
  std::uint32_t type_size() const;
};

/// Null when texels of that format are not read.
const TexelFormat* find_format(std::uint32_t number);

/// The format that pixels of a type are written in: float32 and half with alpha, rgb9e5, r11g11b10.
const TexelFormat& format_for(PixelType type);

/// `VK_FORMAT_BC7_SRGB_BLOCK`, or `VkFormat 1000054000` for one of an extension.
std::string format_name(std::uint32_t number);

}  // namespace welkin::io::ktx2
