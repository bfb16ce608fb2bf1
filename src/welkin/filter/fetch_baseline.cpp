#include "welkin/filter/fetch_impl.h"

namespace welkin {

FetchKernels fetch_kernels_baseline(int channels) {
  return FetchTable<xsimd::default_arch, BaselineFour>::of(channels);
}

}  // namespace welkin
