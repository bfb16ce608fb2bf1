#pragma once

#include <vector>

#include "welkin/lobe/lobe.h"

namespace welkin::prefilter {

/// A lobe sampled for fast sums: linear between values at even steps of c/(c + core), c the chord of the
/// angle. Relative to the lobe's largest value it is off by 1e-6 where the lobe is smooth.
struct SampledLobe {
  explicit SampledLobe(const lobe::AnyLobe& lobe);

  static constexpr int kSteps = 4096;
  float core = 1;
  std::vector<float> values;  ///< kSteps + 2
};

}  // namespace welkin::prefilter
