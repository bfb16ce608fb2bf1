#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "welkin/lobe/lobe.h"

namespace welkin::prefilter {

/// A lobe sampled once, for many evaluations: linear between values at even steps of c/(c + core), c the
/// chord of the angle, from the axis to the opposite direction.
class ChordSamples {
 public:
  /// Values are weights times `scale`.
  ChordSamples(const lobe::AnyLobe& lobe, double core, int steps, double scale = 1);

  double at_chord(double chord) const {
    const double position = std::min(1.0, chord / (chord + core_) / last_) * steps_;
    const std::size_t below = static_cast<std::size_t>(position);
    return values_[below] + (position - static_cast<double>(below)) * (values_[below + 1] - values_[below]);
  }
  /// steps + 2 of them.
  const std::vector<double>& values() const { return values_; }

 private:
  double core_, last_;
  int steps_;
  std::vector<double> values_;
};

/// ChordSamples in float, for fast sums: linear between values at even steps of c/(c + core), c the chord of
/// the angle. Relative to the lobe's largest value it is off by 1e-6 where the lobe is smooth.
struct SampledLobe {
  explicit SampledLobe(const lobe::AnyLobe& lobe);

  static constexpr int kSteps = 4096;
  float core = 1;
  std::vector<float> values;  ///< kSteps + 2
};

}  // namespace welkin::prefilter
