#pragma once

#include <string_view>

#include "welkin/io/jxl/jxl_test_files.h"

/// JPEG XL files with gain maps, which libjxl 0.7 does not write.
namespace welkin::io::test {

inline void append(Bytes& bytes, std::string_view text) {
  for (const char c : text) bytes.push_back(static_cast<std::byte>(c));
}

inline void append(Bytes& bytes, const Bytes& more) {
  bytes.insert(bytes.end(), more.begin(), more.end());
}

inline void append_big_endian(Bytes& bytes, std::uint64_t value, int size) {
  for (int shift = 8 * (size - 1); shift >= 0; shift -= 8)
    bytes.push_back(static_cast<std::byte>(value >> shift & 255));
}

/// ISO 21496-1's, of fractions: these headrooms, minimum 0, maximum 3, gamma 1, both offsets 0.
inline Bytes gain_map_metadata_bytes(unsigned base_headroom = 0, unsigned alternate_headroom = 3) {
  Bytes bytes;
  constexpr unsigned kOneChannelOfBaseColours = 0x40;
  append_big_endian(bytes, kOneChannelOfBaseColours, 5);  // after two versions, 0
  for (const unsigned number :
       {base_headroom, 1u, alternate_headroom, 1u, 0u, 1u, 3u, 1u, 1u, 1u, 0u, 1u, 0u, 1u})
    append_big_endian(bytes, number, 4);
  return bytes;
}

/// The content of a box `jhgm`, with something in place of the alternate picture's colours and profile.
inline Bytes gain_map_box(const Bytes& metadata, const Bytes& codestream, unsigned version = 0) {
  constexpr std::string_view kColours = "abc", kProfile = "defgh";
  Bytes content;
  append_big_endian(content, version, 1);
  append_big_endian(content, metadata.size(), 2);
  append(content, metadata);
  append_big_endian(content, kColours.size(), 1);
  append(content, kColours);
  append_big_endian(content, kProfile.size(), 4);
  append(content, kProfile);
  append(content, codestream);
  return content;
}

/// `picture` as a file of boxes, with one more behind it.
inline Bytes jxl_with_box(const Image& picture, std::string_view type, const Bytes& content) {
  JxlOptions options;
  options.container = true;
  Bytes file = encoded_jxl(picture, options);
  constexpr std::size_t kHeader = 8;
  append_big_endian(file, content.size() + kHeader, 4);
  append(file, type);
  append(file, content);
  return file;
}

}  // namespace welkin::io::test
