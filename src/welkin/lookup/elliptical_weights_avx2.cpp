// Compiled with -mavx2 -mfma; called only when the processor has both.
#include "welkin/lookup/elliptical_weights_impl.h"

namespace welkin {

WeighDirections weigh_directions_avx2() {
  return &WeighOf<xsimd::fma3<xsimd::avx2>>::weigh;
}

}  // namespace welkin
