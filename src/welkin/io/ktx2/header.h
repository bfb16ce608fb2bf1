#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "welkin/io/format.h"
#include "welkin/io/texels/formats.h"
#include "welkin/io/texels/picture_set.h"

/// The structure of a KTX2 file: header, index and level index, checked here so that nothing behind this file
/// meets an offset or a size that the file does not hold. Source: "KTX File Format Specification", version 2
/// (Khronos).
///
///     identifier, 12 bytes            0
///     header, nine words              12
///     index                           48    where descriptor, key/values and global data lie
///     level index                     80    24 bytes for each level, the finest first
///     data format descriptor
///     key/value data
///     levels, the coarsest first            of each level: layer by layer, face by face, row by row
namespace welkin::io::ktx2 {

using texels::TexelFormat;

/// Numbered as in the file.
enum class Scheme : std::uint32_t { none = 0, zstd = 2, zlib = 3 };

std::string_view name_of(Scheme scheme);

struct Section {
  std::uint64_t offset = 0;
  std::uint64_t bytes = 0;
};

struct Level {
  Section stored;
  std::uint64_t unpacked_bytes = 0;
};

struct Header {
  const TexelFormat* format = nullptr;
  int width = 0;
  int height = 0;  ///< 1 of a texture of one dimension
  bool one_dimensional = false;
  int layers = 0;  ///< 0 when it is no array
  int faces = 1;
  bool asks_for_levels = false;  ///< the file has one level, of which its reader should make the others
  Scheme scheme = Scheme::none;
  Section descriptor, keys;
  std::vector<Level> levels;  ///< the finest first

  texels::TextureShape shape() const {
    return {width, height, static_cast<int>(levels.size()), layers, faces};
  }
  int width_of(std::size_t level) const { return shape().width_of(static_cast<int>(level)); }
  int height_of(std::size_t level) const { return shape().height_of(static_cast<int>(level)); }
  /// Of one face of one layer, unpacked.
  std::uint64_t picture_bytes(std::size_t level) const;
  std::uint64_t level_bytes(std::size_t level) const;
};

bool is_ktx2(std::span<const std::byte> bytes);

/// Parses and checks: a format that is read; sizes within ReadOptions::max_bytes, as floats and as unpacked
/// levels; unpacked sizes that are what the format demands, and packed ones that can unpack to them; sections
/// inside the file that do not overlap. Throws Error with the byte offset where it helps.
Header parse_header(const Source& source);

/// Bytes before the data format descriptor.
std::uint64_t header_bytes(std::size_t levels);

/// How a level's offset is aligned: lcm(bytes of a texel or block, 4), or 1 when it is supercompressed.
std::uint64_t level_alignment(const Header& header);

/// Identifier, header, index and level index as they are written.
std::vector<std::byte> written_header(const Header& header);

}  // namespace welkin::io::ktx2
