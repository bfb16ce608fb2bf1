// Compiled with -mavx2 -mfma; called only when the processor has both. Packs of four are tagged sse4_2, which
// nothing else uses (xsimd 8.1 has no four-lane arch of its own for AVX2); the compiler fuses their
// multiply-adds.
#include "welkin/filter/fetch_impl.h"

namespace welkin {

FetchKernels fetch_kernels_avx2(int channels) {
  return FetchTable<xsimd::fma3<xsimd::avx2>, xsimd::sse4_2>::of(channels);
}

}  // namespace welkin
