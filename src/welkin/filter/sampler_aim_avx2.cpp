// Compiled with -mavx2 -mfma; called only when the processor has both.
#include "welkin/filter/sampler_aim_impl.h"

namespace welkin {

Aim aim_avx2() {
  return &AimOf<xsimd::fma3<xsimd::avx2>>::run;
}

}  // namespace welkin
