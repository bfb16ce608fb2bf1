#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "welkin/io/format.h"
#include "welkin/io/texels/formats.h"
#include "welkin/io/texels/picture_set.h"

/// The structure of a DDS file, checked here so that nothing behind this file meets an offset or a size that
/// the file does not hold. Source: Microsoft, "Programming Guide for DDS".
///
///     magic `DDS `, header of 31 words    0
///     header of Direct3D 10, five words   128    where the first says so
///     pictures                                   layer by layer, face by face, level by level
namespace welkin::io::dds {

enum class Alpha { straight, premultiplied, none };

struct Header {
  const texels::TexelFormat* format = nullptr;
  texels::TextureShape shape;
  Alpha alpha = Alpha::straight;
  bool srgb = false;        ///< the file says that its values are sRGB-encoded
  bool grey = false;        ///< its one channel is luminance
  bool modern = false;      ///< it has the header of Direct3D 10
  std::uint64_t first = 0;  ///< byte at which the pictures begin

  std::uint64_t picture_bytes(int level) const;
  /// Where a picture begins.
  std::uint64_t offset(int level, int layer, int face) const;
  std::uint64_t end() const { return offset(0, shape.layer_count(), 0); }
};

bool is_dds(std::span<const std::byte> bytes);

/// Parses and checks: texels that are read, sizes within ReadOptions::max_bytes, pictures inside the file.
/// Throws Error with the byte offset where it helps.
Header parse_header(const Source& source);

/// Magic and headers as they are written: Direct3D 9's alone where it has a name for the texels of pictures
/// and cubes without alpha of their own, since more programs read it.
std::vector<std::byte> written_header(const texels::TextureShape& shape, PixelType type, bool premultiplied);

}  // namespace welkin::io::dds
