// Any bytes as a lobe's table of angles, CSV. Only Error may come out; what was read can be integrated.

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "memory_file.h"
#include "welkin/base/error.h"
#include "welkin/lobe/lobe.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace welkin;
  fuzz::MemoryFile file;
  file.append(data, size);
  try {
    const lobe::AnyLobe lobe = lobe::AnyLobe::make("table,file=" + file.path());
    for (const double s : {0.0, 1e-6, 0.5, 1.0, 2.0}) {
      if (!(lobe.weight(s) >= 0) || !std::isfinite(lobe.weight(s))) __builtin_trap();
    }
    if (!(lobe.integral() > 0) || !(lobe.width() > 0)) __builtin_trap();
  } catch (const Error&) {
  }
  return 0;
}
