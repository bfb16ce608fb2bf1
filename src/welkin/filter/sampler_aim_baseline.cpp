#include "welkin/filter/sampler_aim_impl.h"

namespace welkin {

Aim aim_baseline() {
  return &AimOf<xsimd::default_arch>::run;
}

}  // namespace welkin
