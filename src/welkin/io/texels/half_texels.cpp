#include "welkin/io/texels/half_texels.h"

#ifdef WELKIN_HAS_AVX2
#include <cpuid.h>
#endif

#include "welkin/base/cpu.h"

namespace welkin::io::texels {

#ifdef WELKIN_HAS_AVX2
void encode_half_texels_f16c(const float* in, int channels, int count, std::byte* out, std::uint64_t& above);
void decode_half_texels_f16c(const std::byte* in, int count, float* out, int channels);

namespace {
/// Decided once: virtual machines leave the processor for every cpuid.
bool has_f16c() {
  static const bool has = [] {
    // Not __builtin_cpu_supports: Clang 14 doesn't know the name.
    unsigned a = 0, b = 0, c = 0, d = 0;
    return instruction_set() == InstructionSet::avx2 && __get_cpuid(1, &a, &b, &c, &d) != 0 &&
           (c & bit_F16C) != 0;
  }();
  return has;
}
}  // namespace

EncodeHalfTexels encode_half_texels() {
  return has_f16c() ? encode_half_texels_f16c : nullptr;
}
DecodeHalfTexels decode_half_texels() {
  return has_f16c() ? decode_half_texels_f16c : nullptr;
}
#else
EncodeHalfTexels encode_half_texels() {
  return nullptr;
}
DecodeHalfTexels decode_half_texels() {
  return nullptr;
}
#endif

}  // namespace welkin::io::texels
