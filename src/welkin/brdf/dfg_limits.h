#pragma once

#include <algorithm>

#include "welkin/brdf/dfg.h"

namespace welkin::brdf {

/// The sums without what errors of quadrature or interpolation take them beyond their limits: 0 ≤ ∫Fc ≤ ∫1,
/// and ∫1 ≤ 1 by Smith's masking.
inline SplitSum within_limits(SplitSum sum, GgxMasking masking) {
  const bool smith = masking == GgxMasking::correlated || masking == GgxMasking::separable;
  if (smith) sum.one = std::min(sum.one, 1.0);
  sum.fc = std::clamp(sum.fc, 0.0, sum.one);
  return sum;
}

}  // namespace welkin::brdf
