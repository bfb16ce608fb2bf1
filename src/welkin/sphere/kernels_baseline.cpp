#include "welkin/sphere/kernels_impl.h"

namespace welkin::sphere {

const Kernels& kernels_baseline(std::size_t index) {
  return kernels_at<xsimd::default_arch>(AllParameterizations{}, index);
}

}  // namespace welkin::sphere
