// Any bytes as an XMP packet, asked for a panorama and for a gain map. Only Error may come out.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "welkin/base/error.h"
#include "welkin/io/colour/gain_map.h"
#include "welkin/io/xmp.h"

namespace {

/// What was read can be written, and is read again.
void check_rewritten(const welkin::io::Panorama& panorama) {
  std::vector<std::string> warnings;
  try {
    const auto again = welkin::io::panorama_from(welkin::io::Xmp(welkin::io::xmp_of(panorama)), warnings);
    const std::string projection = again ? again->projection : "";
    if (projection != panorama.projection || !warnings.empty()) __builtin_trap();
  } catch (const welkin::Error&) {
    __builtin_trap();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace welkin;
  try {
    const io::Xmp xmp(std::string_view(reinterpret_cast<const char*>(data), size));
    std::vector<std::string> warnings;
    if (const auto panorama = io::panorama_from(xmp, warnings)) check_rewritten(*panorama);
    static_cast<void>(io::gain_map_metadata(xmp));
  } catch (const Error&) {
  }
  return 0;
}
