// Compiled with -mavx2 -mfma -mf16c; called only when the processor has all of them.
#include "welkin/lookup/gaussian_kernels_impl.h"

namespace welkin {

const GaussianKernels& gaussian_kernels_avx2() {
  return GaussianOf<xsimd::fma3<xsimd::avx2>>::table();
}

}  // namespace welkin
