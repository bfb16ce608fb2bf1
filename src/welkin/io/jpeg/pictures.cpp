#include "welkin/io/jpeg/pictures.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <optional>

#include "welkin/io/byte_order.h"

namespace welkin::io {
namespace {

constexpr unsigned kStartOfImage = 0xd8, kEndOfImage = 0xd9, kStartOfScan = 0xda, kRestart0 = 0xd0,
                   kTemporary = 0x01;

/// The byte after the end of the image that begins the span; nothing when its markers don't lead there.
std::optional<std::size_t> end_of(std::span<const std::byte> bytes) {
  const auto at_byte = [&](std::size_t i) { return std::to_integer<unsigned>(bytes[i]); };
  std::size_t at = 2;
  while (at + 2 <= bytes.size()) {
    if (at_byte(at) != 0xff) return std::nullopt;
    const unsigned marker = at_byte(at + 1);
    if (marker == 0xff) {  // fill
      ++at;
      continue;
    }
    at += 2;
    if (marker == kEndOfImage) return at;
    if (marker == kTemporary || (marker >= kRestart0 && marker <= kStartOfImage)) continue;
    if (at + 2 > bytes.size()) return std::nullopt;
    const std::size_t length = load<std::uint16_t>(&bytes[at], std::endian::big);
    if (length < 2 || length > bytes.size() - at) return std::nullopt;
    at += length;
    if (marker != kStartOfScan) continue;
    // Coded pixels go on to a marker: 0xff followed by neither 0 nor a restart.
    while (at + 2 <= bytes.size()) {
      const auto* const start = bytes.data() + at;
      const auto* const found =
          static_cast<const std::byte*>(std::memchr(start, 0xff, bytes.size() - at - 1));
      if (found == nullptr) return std::nullopt;
      at += static_cast<std::size_t>(found - start);
      const unsigned next = at_byte(at + 1);
      if (next != 0 && !(next >= kRestart0 && next < kStartOfImage)) break;
      at += 2;
    }
  }
  return std::nullopt;
}

}  // namespace

std::vector<std::span<const std::byte>> jpegs_in(std::span<const std::byte> file, std::size_t most) {
  constexpr std::byte kStart[] = {std::byte{0xff}, std::byte{kStartOfImage}, std::byte{0xff}};
  std::vector<std::span<const std::byte>> pictures;
  while (pictures.size() < most) {
    const auto found = std::search(file.begin(), file.end(), std::begin(kStart), std::end(kStart));
    if (found == file.end()) break;
    file = file.subspan(static_cast<std::size_t>(found - file.begin()));
    const auto end = end_of(file);
    pictures.push_back(file.first(end.value_or(file.size())));
    if (!end) break;
    file = file.subspan(*end);
  }
  return pictures;
}

}  // namespace welkin::io
