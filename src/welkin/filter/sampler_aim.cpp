#include "welkin/filter/sampler_aim.h"

#include "welkin/base/cpu.h"

namespace welkin {

FloatOrientation::FloatOrientation(const Matrix3& matrix) : identity(matrix == Matrix3{}) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) m[i][j] = static_cast<float>(matrix.rows[i][j]);
  }
}

AimKernels aim_kernels() {
#ifdef WELKIN_HAS_AVX2
  if (instruction_set() == InstructionSet::avx2) return aim_kernels_avx2();
#endif
  return aim_kernels_baseline();
}

}  // namespace welkin
