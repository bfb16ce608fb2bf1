#include "welkin/filter/refinement_impl.h"

namespace welkin {

ReconstructionKernels reconstruction_kernels_baseline(int channels) {
  return reconstruction_kernels_of<xsimd::default_arch, BaselineFour>(channels);
}

}  // namespace welkin
