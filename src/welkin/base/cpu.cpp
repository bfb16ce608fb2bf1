#include "welkin/base/cpu.h"

#ifdef WELKIN_HAS_AVX2
#include <cpuid.h>
#endif

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

bool has_f16c() {
#ifdef WELKIN_HAS_AVX2
  // Decided once: virtual machines leave the processor for every cpuid.
  static const bool has = [] {
    // Not __builtin_cpu_supports: Clang 14 doesn't know the name.
    unsigned a = 0, b = 0, c = 0, d = 0;
    return instruction_set() == InstructionSet::avx2 && __get_cpuid(1, &a, &b, &c, &d) != 0 &&
           (c & bit_F16C) != 0;
  }();
  return has;
#else
  return false;
#endif
}

}  // namespace welkin
