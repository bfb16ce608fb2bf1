#include "welkin/lobe/kernels_impl.h"

namespace welkin::lobe {

Weights weights_baseline(std::size_t index) {
  return weights_at<xsimd::default_arch>(AllLobes{}, index);
}

PointSums point_sums_baseline(std::size_t index) {
  return point_sums_at<xsimd::default_arch>(AllLobes{}, index);
}

LegendreSums legendre_sums_baseline() {
  return &Legendre<xsimd::default_arch>::sums;
}

}  // namespace welkin::lobe
