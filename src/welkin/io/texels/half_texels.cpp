#include "welkin/io/texels/half_texels.h"

#include "welkin/base/cpu.h"

namespace welkin::io::texels {

#ifdef WELKIN_HAS_AVX2
void encode_half_texels_f16c(const float* in, int channels, int count, std::byte* out, std::uint64_t& above);
void decode_half_texels_f16c(const std::byte* in, int count, float* out, int channels);

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
