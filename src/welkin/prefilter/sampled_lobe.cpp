#include "welkin/prefilter/sampled_lobe.h"

namespace welkin::prefilter {

ChordSamples::ChordSamples(const lobe::AnyLobe& lobe, double core, int steps, double scale)
    : core_(core), last_(2 / (2 + core)), steps_(steps) {
  for (int i = 0; i <= steps + 1; ++i) {
    const double part = std::min(last_, last_ * i / steps), chord = std::min(2.0, core * part / (1 - part));
    values_.push_back(scale * lobe.weight(chord * chord / 2));
  }
}

SampledLobe::SampledLobe(const lobe::AnyLobe& lobe) : core(static_cast<float>(2 * lobe.width())) {
  const ChordSamples samples(lobe, static_cast<double>(core), kSteps);
  values.assign(samples.values().begin(), samples.values().end());
}

}  // namespace welkin::prefilter
