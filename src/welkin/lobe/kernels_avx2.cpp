// Compiled with -mavx2 -mfma; called only when the processor has both.
#include "welkin/lobe/kernels_impl.h"

namespace welkin::lobe {

Weights weights_avx2(std::size_t index) {
  return weights_at<xsimd::fma3<xsimd::avx2>>(AllLobes{}, index);
}

PointSums point_sums_avx2(std::size_t index) {
  return point_sums_at<xsimd::fma3<xsimd::avx2>>(AllLobes{}, index);
}

LegendreSums legendre_sums_avx2() {
  return &Legendre<xsimd::fma3<xsimd::avx2>>::sums;
}

}  // namespace welkin::lobe
