#pragma once

#include <tiffio.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "welkin/io/test_pictures.h"

/// TIFF files of any kind, byte by byte, since no writer makes most of them.
namespace welkin::io::test {

struct OtherTiff {
  struct Value {
    int type = 3;  ///< SHORT
    std::vector<std::uint32_t> numbers = {};
    Bytes bytes = {};  ///< of types 1 (BYTE), 5 (RATIONAL), 7 (UNDEFINED)
  };

  int width = 1, height = 1, samples = 1, bits = 8, format = 1, photometric = 1;
  bool planar = false, big_endian = false;
  Bytes data = {};                 ///< one strip, or one for each plane
  std::map<int, Value> more = {};  ///< further fields, and others in place of those above
  std::int64_t offset = -1;        ///< of the strip, if it shall be said to be elsewhere

  Bytes file() const { return pages({*this}); }
  static Bytes pages(const std::vector<OtherTiff>& all);
};

inline void put(Bytes& bytes, std::uint64_t value, int size, bool big_endian) {
  for (int i = 0; i < size; ++i)
    bytes.push_back(static_cast<std::byte>(value >> 8 * (big_endian ? size - 1 - i : i) & 0xff));
}

inline Bytes OtherTiff::pages(const std::vector<OtherTiff>& all) {
  const bool big = all.front().big_endian;
  Bytes bytes = bytes_of(big ? "MM" : "II");
  put(bytes, 42, 2, big);
  std::size_t link = bytes.size();
  put(bytes, 0, 4, big);
  const auto set_link = [&](std::size_t at, std::size_t value) {
    Bytes word;
    put(word, value, 4, big);
    std::copy(word.begin(), word.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at));
  };
  for (const OtherTiff& page : all) {
    const std::size_t planes = page.planar ? static_cast<std::size_t>(page.samples) : 1;
    const std::size_t of_plane = page.data.size() / planes, data_at = bytes.size();
    bytes.insert(bytes.end(), page.data.begin(), page.data.end());
    const auto u = [](int value) { return static_cast<std::uint32_t>(value); };
    Value offsets{4}, counts{4};
    for (std::size_t k = 0; k < planes; ++k) {
      const std::size_t at = data_at + k * of_plane;
      offsets.numbers.push_back(
          static_cast<std::uint32_t>(page.offset < 0 ? at : static_cast<std::size_t>(page.offset)));
      counts.numbers.push_back(static_cast<std::uint32_t>(of_plane));
    }
    const auto samples = static_cast<std::size_t>(page.samples);
    std::map<int, Value> fields = page.more;
    fields.insert({{256, {4, {u(page.width)}}},
                   {257, {4, {u(page.height)}}},
                   {258, {3, std::vector<std::uint32_t>(samples, u(page.bits))}},
                   {259, {3, {1}}},
                   {262, {3, {u(page.photometric)}}},
                   {273, offsets},
                   {277, {3, {u(page.samples)}}},
                   {278, {4, {u(page.height)}}},
                   {279, counts},
                   {284, {3, {page.planar ? 2u : 1u}}},
                   {339, {3, std::vector<std::uint32_t>(samples, u(page.format))}}});
    std::vector<Bytes> values;
    for (auto& [tag, value] : fields) {
      Bytes stored = value.bytes;
      for (const std::uint32_t number : value.numbers) put(stored, number, value.type == 3 ? 2 : 4, big);
      values.push_back(stored);
    }
    for (Bytes& value : values) {
      if (value.size() <= 4) continue;
      const std::size_t at = bytes.size();
      bytes.insert(bytes.end(), value.begin(), value.end());
      value.clear();
      put(value, at, 4, big);
      value.push_back(std::byte{1});  // marks an offset
    }
    if (bytes.size() % 2 != 0) bytes.push_back({});
    set_link(link, bytes.size());
    put(bytes, fields.size(), 2, big);
    std::size_t i = 0;
    for (const auto& [tag, value] : fields) {
      put(bytes, static_cast<std::uint64_t>(tag), 2, big);
      put(bytes, static_cast<std::uint64_t>(value.type), 2, big);
      put(bytes, value.bytes.empty() ? value.numbers.size() : value.bytes.size() / (value.type == 5 ? 8 : 1),
          4, big);
      Bytes inside = values[i++];
      inside.resize(4);
      bytes.insert(bytes.end(), inside.begin(), inside.end());
    }
    link = bytes.size();
    put(bytes, 0, 4, big);
  }
  return bytes;
}

/// Rows of `per_row` integers each, packed from the most significant bit on, each row to whole bytes.
inline Bytes packed(const std::vector<std::uint32_t>& codes, int bits, std::size_t per_row) {
  Bytes bytes;
  for (std::size_t first = 0; first < codes.size(); first += per_row) {
    int used = 8;
    for (std::size_t i = first; i < first + per_row; ++i) {
      for (int bit = bits - 1; bit >= 0; --bit) {
        if (used == 8) {
          bytes.push_back({});
          used = 0;
        }
        if ((codes[i] >> bit & 1) != 0) bytes.back() |= static_cast<std::byte>(0x80 >> used);
        ++used;
      }
    }
  }
  return bytes;
}

}  // namespace welkin::io::test
