// Compiled with -mavx2 -mfma; called only when the processor has both.
#include "welkin/sphere/kernels_impl.h"

namespace welkin::sphere {

const Kernels& kernels_avx2(std::size_t index) {
  return kernels_at<xsimd::fma3<xsimd::avx2>>(AllParameterizations{}, index);
}

}  // namespace welkin::sphere
