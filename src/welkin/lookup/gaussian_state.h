#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "welkin/filter/sampler.h"
#include "welkin/lookup/gaussian_kernels.h"
#include "welkin/lookup/gaussian_levels.h"
#include "welkin/lookup/gaussian_stack.h"
#include "welkin/lookup/gaussian_taps.h"

/// How a GaussianStack looks cones up. Internal to lookup.
namespace welkin {

/// Rules for each reach.
using TapRules = std::vector<GaussianTapRules>;
const TapRules& tap_rules(GaussianAccuracy accuracy);

/// What copies share.
class GaussianStack::State {
 public:
  State(Sampler source, const Map& map, const GaussianStackOptions& options, const Monitor& monitor)
      : source_(std::move(source)),
        levels_(make_gaussian_levels(map, options.accuracy, monitor)),
        rules_(tap_rules(options.accuracy)),
        kernels_(gaussian_kernels()) {
    const float lowest = levels_.intervals[0].lowest;
    base_ = std::log2(lowest);
    per_step_ = static_cast<float>(levels_.intervals.size()) / (std::log2(levels_.highest) - base_);
    bilinear_ = static_cast<float>(levels_.texel * levels_.texel / 6);
    narrowest_tap_ = static_cast<float>(std::sqrt(std::max(double{bilinear_}, 1e-12)));
  }

  int channels() const { return levels_.channels; }
  std::size_t bytes() const { return levels_.halves.size(); }
  double texel() const { return levels_.texel; }

  void look_up(std::span<const EllipticalCone> cones, std::span<float> radiance) const;

 private:
  struct Pending;
  struct Batch;
  static constexpr std::size_t kFewChannels = 4;

  /// What the levels have in a cone of this σ²; below them the source's bilinear interpolation has the rest.
  float share_of(float variance) const {
    return std::clamp((variance - bilinear_) / (levels_.intervals[0].lowest - bilinear_), 0.0f, 1.0f);
  }

  std::size_t width() const { return 2 * static_cast<std::size_t>(levels_.channels); }
  const std::uint16_t* texels_of(const GaussianInterval& interval) const {
    return levels_.values() + static_cast<std::size_t>(interval.first) * width();
  }
  std::size_t pitch_of(const GaussianInterval& interval) const {
    return static_cast<std::size_t>(interval.size + 2) * width();
  }
  const GaussianInterval& interval_at(float variance) const;
  const GaussianTapRules& rules_at(const GaussianInterval& interval) const {
    return rules_[static_cast<std::size_t>(interval.reach)];
  }
  /// A look-up's last step: from the sums of the pair to radiance.
  void finish(const GaussianInterval& interval, float variance, const float* sums, float* out) const;
  void flush(Batch& batch, float* sums, float* radiance) const;
  void look_up_alone(const EllipticalCone& cone, Batch& batch, float* sums, float* out) const;
  void add_source(const GaussianTaps& taps, std::size_t count, double* out) const;

  Sampler source_;
  GaussianLevels levels_;
  const TapRules& rules_;
  const GaussianKernels& kernels_;
  float base_, per_step_;  ///< log2 of the least σ²; intervals for each doubling
  float bilinear_;         ///< σ² of the source's bilinear interpolation
  float narrowest_tap_;    ///< σ of the narrowest thing that taps can see
};

/// A cone whose taps are in the batch.
struct GaussianStack::State::Pending {
  const GaussianInterval* interval;
  float variance;  ///< σ² at which the levels are looked up
  float share;     ///< that the levels have; the source has the rest
  std::size_t cone, from, to;
};

struct GaussianStack::State::Batch {
  GaussianTaps taps;
  std::size_t used = 0, waiting = 0;
  Pending pending[GaussianTaps::kMost];
};

}  // namespace welkin
