#include "welkin/lookup/elliptical_weights_impl.h"

namespace welkin {

WeighDirections weigh_directions_baseline() {
  return &WeighOf<xsimd::default_arch>::weigh;
}

}  // namespace welkin
