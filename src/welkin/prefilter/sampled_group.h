#pragma once

#include <cstddef>
#include <vector>

#include "welkin/lobe/lobe.h"

namespace welkin::prefilter {

/// Several lobes sampled at the same chords (see ChordSamples), for levels of one size that are summed
/// together: a point's place in the table, once found, serves all of them.
struct SampledGroup {
  static constexpr int kSteps = 2048, kPack = 8;

  /// The least of the lobes' cores suits all. `scales`: of each lobe's weights.
  SampledGroup(const std::vector<const lobe::AnyLobe*>& lobes, double core,
               const std::vector<double>& scales);

  float core;
  std::size_t members;        ///< a multiple of kPack; those past the lobes are 0
  std::vector<float> values;  ///< [step][member], kSteps + 2 steps
};

}  // namespace welkin::prefilter
