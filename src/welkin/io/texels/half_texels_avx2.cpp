// Compiled with -mavx2 -mfma -mf16c; called only when the processor has all of them.
#include <immintrin.h>

#include <cstring>

#include "welkin/io/texels/half_texels.h"

namespace welkin::io::texels {

void encode_half_texels_f16c(const float* in, int channels, int count, std::byte* out, std::uint64_t& above) {
  const __m128 largest = _mm_set1_ps(65504), sign = _mm_set1_ps(-0.0f), one = _mm_set1_ps(1);
  const __m128 infinity = _mm_castsi128_ps(_mm_set1_epi32(0x7f800000));
  std::uint64_t counted = 0;
  const auto texel = [&](__m128 values, std::byte* to) {
    if (channels == 3) values = _mm_blend_ps(values, one, 8);
    const __m128 magnitude = _mm_andnot_ps(sign, values);
    const __m128 over = _mm_and_ps(_mm_cmpgt_ps(magnitude, largest), _mm_cmplt_ps(magnitude, infinity));
    const int mask = _mm_movemask_ps(over);
    if (mask != 0) {
      counted += static_cast<unsigned>(__builtin_popcount(static_cast<unsigned>(mask)));
      values = _mm_blendv_ps(values, _mm_or_ps(largest, _mm_and_ps(sign, values)), over);
    }
    const __m128i halves = _mm_cvtps_ph(values, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC);
    std::memcpy(to, &halves, 8);
  };
  // A texel of three is read with the next one's first value; the last by itself.
  for (int i = 0; i + 1 < count; ++i, in += channels, out += 8) texel(_mm_loadu_ps(in), out);
  float last[4] = {};
  std::memcpy(last, in, static_cast<std::size_t>(channels) * sizeof(float));
  texel(_mm_loadu_ps(last), out);
  above += counted;
}

void decode_half_texels_f16c(const std::byte* in, int count, float* out, int channels) {
  for (int i = 0; i + 1 < count; ++i, in += 8, out += channels)
    _mm_storeu_ps(out, _mm_cvtph_ps(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(in))));
  float last[4];
  _mm_storeu_ps(last, _mm_cvtph_ps(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(in))));
  std::memcpy(out, last, static_cast<std::size_t>(channels) * sizeof(float));
}

}  // namespace welkin::io::texels
