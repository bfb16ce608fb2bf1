#pragma once

#include <zlib.h>

#include <string>
#include <vector>

#include "welkin/io/test_pictures.h"

/// PNGs made by hand, for tests.
namespace welkin::io::test {

using Values = std::vector<int>;

inline std::string big_endian(std::size_t value) {
  std::string text;
  for (int shift = 24; shift >= 0; shift -= 8) text += static_cast<char>(value >> shift & 255);
  return text;
}

inline std::string text_of(const Values& values) {
  std::string text;
  for (const int value : values) text += static_cast<char>(value);
  return text;
}

inline std::string deflated(const std::string& raw) {
  std::string packed(compressBound(static_cast<uLong>(raw.size())), 0);
  auto size = static_cast<uLongf>(packed.size());
  compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(raw.data()),
           static_cast<uLong>(raw.size()));
  packed.resize(size);
  return packed;
}

inline std::string chunk(const std::string& name, const std::string& data) {
  const std::string body = name + data;
  const auto* bytes = reinterpret_cast<const Bytef*>(body.data());
  return big_endian(data.size()) + body + big_endian(crc32(0, bytes, static_cast<uInt>(body.size())));
}

/// `rows` are filtered rows, `extra` the chunks before the pixels.
inline Bytes picture(int width, int height, int depth, int colour_type, const Values& rows,
                     const std::string& extra = "", bool interlaced = false) {
  const std::string header = big_endian(static_cast<std::size_t>(width)) +
                             big_endian(static_cast<std::size_t>(height)) +
                             text_of({depth, colour_type, 0, 0, interlaced ? 1 : 0});
  return bytes_of("\x89PNG\r\n\x1a\n" + chunk("IHDR", header) + extra +
                  chunk("IDAT", deflated(text_of(rows))) + chunk("IEND", ""));
}

inline constexpr int kGrey = 0, kColour = 2, kPalette = 3, kGreyAlpha = 4, kColourAlpha = 6;

}  // namespace welkin::io::test
