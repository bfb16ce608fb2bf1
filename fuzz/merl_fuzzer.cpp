// Any bytes as a file of the MERL database. Only Error may come out; what was read has values everywhere.
// A file has 35 MB: a first byte of 'r' stands for the header and as many repetitions of the rest as it
// takes.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>

#include "brdf_values.h"
#include "memory_file.h"
#include "welkin/base/error.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace welkin;
  fuzz::MemoryFile file;
  if (size > 1 && data[0] == 'r') {
    constexpr std::uint32_t kSizes[] = {90, 90, 180};
    constexpr std::size_t kBytes = std::size_t{3} * 8 * 90 * 90 * 180;
    file.append(kSizes, sizeof kSizes);
    std::string piece;
    while (piece.size() < (std::size_t{1} << 16))
      piece.append(reinterpret_cast<const char*>(data) + 1, size - 1);
    for (std::size_t at = 0; at < kBytes; at += piece.size())
      file.append(piece.data(), std::min(piece.size(), kBytes - at));
  } else {
    file.append(data, size);
  }
  try {
    fuzz::look_up_everywhere(brdf::AnyBrdf::make("merl,file=" + file.path()));
  } catch (const Error&) {
  }
  return 0;
}
