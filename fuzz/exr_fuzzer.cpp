// Any bytes as an OpenEXR file: they are read, or refused with welkin::Error. Anything else is a fault.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "welkin/base/error.h"
#include "welkin/io/image_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  welkin::io::ReadOptions options;
  options.max_bytes = std::uint64_t{64} << 20;
  try {
    const auto reader = welkin::io::open(std::as_bytes(std::span(data, size)), "fuzz", options);
    for (std::size_t i = 0; i < reader->info().parts.size(); ++i) {
      const welkin::io::PartInfo& part = reader->info().parts[i];
      std::vector<int> channels;
      for (std::size_t c = 0; c < part.channels.size(); ++c) channels.push_back(static_cast<int>(c));
      welkin::Image image(part.width, part.height, static_cast<int>(channels.size()));
      try {
        reader->read(i, channels, image.view());
      } catch (const welkin::Error&) {
      }
    }
  } catch (const welkin::Error&) {
  }
  return 0;
}
