// Compiled with -mavx2 -mfma; called only when the processor has both.
#include "welkin/filter/sampler_aim_impl.h"

namespace welkin {

AimKernels aim_kernels_avx2() {
  return AimOf<xsimd::fma3<xsimd::avx2>>::kernels();
}

}  // namespace welkin
