#include "welkin/prefilter/sampled_lobe.h"

#include "welkin/prefilter/sampled_group.h"

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

SampledGroup::SampledGroup(const std::vector<const lobe::AnyLobe*>& lobes, double chord,
                           const std::vector<double>& scales)
    : core(static_cast<float>(chord)), members((lobes.size() + kPack - 1) / kPack * kPack) {
  values.resize((kSteps + 2) * members, 0.0f);
  for (std::size_t k = 0; k < lobes.size(); ++k) {
    const ChordSamples samples(*lobes[k], static_cast<double>(core), kSteps, scales[k]);
    for (std::size_t i = 0; i < samples.values().size(); ++i)
      values[i * members + k] = static_cast<float>(samples.values()[i]);
  }
}

}  // namespace welkin::prefilter
