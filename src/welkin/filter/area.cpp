#include "welkin/filter/area.h"

#include "welkin/base/cpu.h"

namespace welkin {

AreaMean area_mean(int channels) {
#ifdef WELKIN_HAS_AVX2
  if (instruction_set() == InstructionSet::avx2) return area_mean_avx2(channels);
#endif
  return area_mean_baseline(channels);
}

}  // namespace welkin
