#include "welkin/filter/sampler_aim_impl.h"

namespace welkin {

AimKernels aim_kernels_baseline() {
  return AimOf<xsimd::default_arch>::kernels();
}

}  // namespace welkin
