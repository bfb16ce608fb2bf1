#include "welkin/prefilter/sampled_lobe.h"

#include <algorithm>
#include <cmath>

namespace welkin::prefilter {

SampledLobe::SampledLobe(const lobe::AnyLobe& lobe) : core(static_cast<float>(2 * lobe.width())) {
  const double last = 2 / (2 + static_cast<double>(core));  // of the opposite direction
  for (int i = 0; i <= kSteps + 1; ++i) {
    const double part = std::min(last, last * i / kSteps);
    const double chord = part >= 1 ? 2 : static_cast<double>(core) * part / (1 - part);
    values.push_back(static_cast<float>(lobe.weight(std::min(2.0, chord * chord / 2))));
  }
}

}  // namespace welkin::prefilter
