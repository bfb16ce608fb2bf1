// Any bytes as an Exif block: an orientation of 1 to 8, or none.

#include <cstddef>
#include <cstdint>
#include <span>

#include "welkin/io/exif.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto orientation = welkin::io::exif_orientation(std::as_bytes(std::span(data, size)));
  if (orientation && (*orientation < 1 || *orientation > 8)) __builtin_trap();
  return 0;
}
