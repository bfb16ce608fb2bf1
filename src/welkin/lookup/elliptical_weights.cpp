#include "welkin/lookup/elliptical_weights.h"

#include "welkin/base/cpu.h"

namespace welkin {

WeighDirections weigh_directions() {
#ifdef WELKIN_HAS_AVX2
  if (instruction_set() == InstructionSet::avx2) return weigh_directions_avx2();
#endif
  return weigh_directions_baseline();
}

}  // namespace welkin
