#include "welkin/io/exif.h"

#include <bit>
#include <cstdint>

#include "welkin/io/byte_order.h"

namespace welkin::io {

std::optional<int> exif_orientation(std::span<const std::byte> exif) {
  constexpr std::size_t kHeaderBytes = 8, kEntryBytes = 12;
  constexpr std::uint16_t kOrientation = 0x0112, kShort = 3;
  if (exif.size() < kHeaderBytes) return {};
  const bool little = exif[0] == std::byte{'I'} && exif[1] == std::byte{'I'};
  const bool big = exif[0] == std::byte{'M'} && exif[1] == std::byte{'M'};
  if (!little && !big) return {};
  const std::endian order = little ? std::endian::little : std::endian::big;
  const std::size_t directory = load<std::uint32_t>(&exif[4], order);
  if (directory > exif.size() || exif.size() - directory < 2) return {};
  const std::size_t entries = load<std::uint16_t>(&exif[directory], order);
  for (std::size_t i = 0; i < entries; ++i) {
    const std::size_t at = directory + 2 + i * kEntryBytes;
    if (exif.size() < at + kEntryBytes) return {};
    if (load<std::uint16_t>(&exif[at], order) != kOrientation) continue;
    if (load<std::uint16_t>(&exif[at + 2], order) != kShort) return {};
    const int orientation = load<std::uint16_t>(&exif[at + 8], order);
    if (orientation < 1 || orientation > 8) return {};
    return orientation;
  }
  return {};
}

}  // namespace welkin::io
