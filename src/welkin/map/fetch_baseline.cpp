#include "welkin/map/area_impl.h"
#include "welkin/map/fetch_impl.h"

namespace welkin {

FetchKernels fetch_kernels_baseline(int channels) {
  return FetchTable<xsimd::default_arch, xsimd::default_arch>::of(channels);
}

AreaMean area_mean_baseline(int channels) {
  return area_mean_of<xsimd::default_arch, xsimd::default_arch>(channels);
}

}  // namespace welkin
