// Any bytes as a BRDF's table of angles. Only Error may come out; what was read has values everywhere.

#include <cstddef>
#include <cstdint>

#include "brdf_values.h"
#include "memory_file.h"
#include "welkin/base/error.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace welkin;
  fuzz::MemoryFile file;
  file.append(data, size);
  try {
    fuzz::look_up_everywhere(brdf::AnyBrdf::make("table,file=" + file.path()));
  } catch (const Error&) {
  }
  return 0;
}
