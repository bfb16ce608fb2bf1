#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "welkin/base/error.h"
#include "welkin/image/image.h"
#include "welkin/io/format.h"

namespace welkin::fuzz {

/// Opens the bytes as a file and decodes every channel of every part, if they are of that format by their
/// magic number. Only Error may come out of the library; anything else is a finding.
inline void decode_all(std::string_view format, const std::uint8_t* data, std::size_t size) {
  constexpr std::uint64_t kMaxBytes = std::uint64_t{64} << 20;
  constexpr std::size_t kMaxParts = 4;  // a file of many small parts only costs time
  const std::span<const std::byte> bytes(reinterpret_cast<const std::byte*>(data), size);
  for (const io::Format& each : io::formats()) {
    if (!each.matches(bytes)) continue;
    // AVIF is read by HEIF's reader.
    const std::string_view name = each.capabilities.format;
    if (name != format && !(name == "avif" && format == "heif")) return;
    break;
  }
  try {
    const auto reader = io::open(bytes, "fuzz", {.max_bytes = kMaxBytes});
    for (std::size_t part = 0; part < std::min(kMaxParts, reader->info().parts.size()); ++part) {
      const io::PartInfo& info = reader->info().parts[part];
      std::vector<int> channels;
      for (int k = 0; k < static_cast<int>(info.channels.size()); ++k) channels.push_back(k);
      Image image(info.width, info.height, static_cast<int>(channels.size()));
      reader->read(part, channels, image.view());
    }
  } catch (const Error&) {
  }
}

}  // namespace welkin::fuzz
