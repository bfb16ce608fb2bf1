// Any bytes as a file of coefficients. Only Error may come out; what was read can be written, and is read
// again.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "welkin/base/error.h"
#include "welkin/harmonics/coefficients_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace welkin;
  using namespace welkin::harmonics;
  try {
    const CoefficientsFile file =
        parse_coefficients(std::string_view(reinterpret_cast<const char*>(data), size), "fuzz");
    static_cast<void>(harmonics_of(file));
    try {
      const std::string text = coefficients_text(file, CoefficientsFormat::json);
      if (parse_coefficients(text, "again").coefficients.values != file.coefficients.values) __builtin_trap();
    } catch (const Error&) {
      __builtin_trap();
    }
  } catch (const Error&) {
  }
  return 0;
}
