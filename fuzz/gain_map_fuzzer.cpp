// Any bytes as a gain map's ISO 21496-1 metadata, and as a file of several JPEGs. Only Error may come out,
// and only numbers that gains can be computed from.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "welkin/base/error.h"
#include "welkin/io/colour/gain_map.h"
#include "welkin/io/jpeg/pictures.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace welkin;
  const auto bytes = std::as_bytes(std::span(data, size));
  try {
    if (const auto metadata = io::gain_map_metadata(bytes)) {
      for (std::size_t c = 0; c < 3; ++c) {
        for (const double value : {metadata->minimum[c], metadata->maximum[c], metadata->gamma[c],
                                   metadata->base_offset[c], metadata->alternate_offset[c]}) {
          if (!std::isfinite(value)) __builtin_trap();
        }
      }
    }
  } catch (const Error&) {
  }
  constexpr std::size_t kMost = 8;
  const auto pictures = io::jpegs_in(bytes, kMost);
  const std::byte* from = bytes.data();
  if (pictures.size() > kMost) __builtin_trap();
  for (const auto& picture : pictures) {  // one after the other, within the file
    if (picture.empty() || picture.data() < from) __builtin_trap();
    from = picture.data() + picture.size();
  }
  if (from > bytes.data() + bytes.size()) __builtin_trap();
  return 0;
}
