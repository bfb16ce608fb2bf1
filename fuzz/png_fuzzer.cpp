#include <zlib.h>

#include "decode_all.h"

namespace {

/// Gives every chunk the checksum that its bytes have, or libpng would stop at each mutation.
void repair_checksums(std::vector<std::uint8_t>& png) {
  constexpr std::size_t kSignatureBytes = 8, kNameAt = 4, kAround = 12;
  for (std::size_t at = kSignatureBytes; at + kAround <= png.size();) {
    std::size_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) length = length << 8 | png[at + i];
    if (length > png.size() - at - kAround) return;
    const uLong checksum = crc32(0, &png[at + kNameAt], static_cast<uInt>(length + 4));
    for (std::size_t i = 0; i < 4; ++i) {
      png[at + 8 + length + i] = static_cast<std::uint8_t>(checksum >> (24 - 8 * i));
    }
    at += kAround + length;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<std::uint8_t> png(data, data + size);
  repair_checksums(png);
  welkin::fuzz::decode_all("png", png.data(), png.size());
  return 0;
}
