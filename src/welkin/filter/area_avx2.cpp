// Compiled with -mavx2 -mfma; called only when the processor has both. See fetch_avx2.cpp for the packs of
// four.
#include "welkin/filter/area_impl.h"

namespace welkin {

AreaMean area_mean_avx2(int channels) {
  return area_mean_of<xsimd::fma3<xsimd::avx2>, xsimd::sse4_2>(channels);
}

}  // namespace welkin
