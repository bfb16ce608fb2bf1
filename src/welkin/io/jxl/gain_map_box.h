#pragma once

#include <cstddef>
#include <span>

/// The box `jhgm` of a JPEG XL file, which holds a gain map.
namespace welkin::io {

struct JxlGainMapBox {
  std::span<const std::byte> metadata;    ///< ISO 21496-1's
  std::span<const std::byte> codestream;  ///< the gain map's picture
};

/// Parts of the box's content: a byte of version, metadata (16 bits of size before them), the alternate
/// picture's colours (8 bits), its ICC profile, compressed (32 bits), both of which are passed over; then the
/// codestream. Numbers are big-endian. Source: libjxl 0.11, `jxl/gain_map.h`. Throws Error (damaged,
/// unsupported) without a file's name.
JxlGainMapBox parse_jxl_gain_map_box(std::span<const std::byte> content);

}  // namespace welkin::io
