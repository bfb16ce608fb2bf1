// Compiled with -mavx2 -mfma; called only when the processor has both. See fetch_avx2.cpp for the packs of
// four.
#include "welkin/filter/refinement_impl.h"

namespace welkin {

ReconstructionKernels reconstruction_kernels_avx2(int channels) {
  return reconstruction_kernels_of<xsimd::fma3<xsimd::avx2>, xsimd::sse4_2>(channels);
}

}  // namespace welkin
