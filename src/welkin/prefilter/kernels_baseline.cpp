#include "welkin/base/cpu.h"
#include "welkin/prefilter/kernels_impl.h"

namespace welkin::prefilter {

const Kernels& kernels_baseline() {
#ifdef __SSE2__
  using Baseline = std::conditional_t<(xsimd::batch<float>::size <= 8), xsimd::default_arch, xsimd::sse2>;
#else
  using Baseline = xsimd::default_arch;
#endif
  return KernelsOf<Baseline>::table();
}

const Kernels& kernels() {
#ifdef WELKIN_HAS_AVX2
  if (instruction_set() == InstructionSet::avx2) return kernels_avx2();
#endif
  return kernels_baseline();
}

}  // namespace welkin::prefilter
