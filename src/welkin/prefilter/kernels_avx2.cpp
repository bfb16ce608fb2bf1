#include "welkin/prefilter/kernels_impl.h"

namespace welkin::prefilter {

const Kernels& kernels_avx2() {
  return KernelsOf<xsimd::fma3<xsimd::avx2>>::table();
}

}  // namespace welkin::prefilter
