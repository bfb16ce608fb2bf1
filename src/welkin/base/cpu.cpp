#include "welkin/base/cpu.h"

#include <cstdlib>
#include <string_view>

namespace welkin {
namespace {

InstructionSet detect() {
#ifdef WELKIN_HAS_AVX2
  const char* wanted = std::getenv("WELKIN_INSTRUCTION_SET");
  if (wanted != nullptr && std::string_view(wanted) == "baseline") return InstructionSet::baseline;
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return InstructionSet::avx2;
#endif
  return InstructionSet::baseline;
}

}  // namespace

InstructionSet instruction_set() {
  static const InstructionSet set = detect();
  return set;
}

}  // namespace welkin
