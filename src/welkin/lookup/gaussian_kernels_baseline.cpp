#include "welkin/lookup/gaussian_kernels_impl.h"

namespace welkin {

const GaussianKernels& gaussian_kernels_baseline() {
  return GaussianOf<xsimd::default_arch>::table();
}

}  // namespace welkin
