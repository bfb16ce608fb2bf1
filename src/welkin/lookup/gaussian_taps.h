#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "welkin/lookup/gaussian_levels.h"

namespace welkin {

/// Which taps along its long axis make an elliptical Gaussian out of round ones. Internal to lookup.
///
/// A Gaussian of variance wide² is one of narrow² convolved with one of σ² = wide² − narrow². As a sum of
/// weights at steps of h, the latter ripples by 2 exp(−2π² (narrow σ / (wide h))²): Poisson's formula, of the
/// product of both spectra where a copy of the one, 2π/h away, meets the other. So steps are
/// `spacing` · narrow σ / wide, out to `reach` · σ to both sides. Where σ is small beside narrow,
/// Gauss–Hermite's rules need fewer.
///
/// How far taps must reach depends on how much brighter than the mean a thing past their end can be: a sun is
/// seen in Gaussian tails where nothing else is.
class GaussianTapRules {
 public:
  static constexpr std::size_t kMost = 128;

  struct Rule {
    std::size_t count = 1;
    const float* nodes = nullptr;  ///< in σ; readable past `count`, as GaussianSpread needs it
    const float* weights = nullptr;
  };

  static constexpr int kReaches = 10;
  /// Reach number `index`.
  static double reach_at(int index) { return 3.25 + 0.25 * index; }
  /// The one for things that are so many times brighter than the mean.
  static int reach_for(double contrast, const GaussianQuality& quality);

  GaussianTapRules(const GaussianQuality& quality, double reach);

  /// How many taps a cone needs, wide > narrow > 0; maybe more than kMost.
  std::size_t count(float wide, float narrow, float sigma) const;
  /// Of at most kMost taps.
  Rule rule(std::size_t count) const { return rules_[count]; }
  double reach() const { return reach_; }

 private:
  double reach_;
  float per_aspect_;             ///< taps for each unit of wide / narrow
  std::array<float, 5> widest_;  ///< σ/narrow up to which the rules of 3 … 7 taps do
  std::vector<float> nodes_, weights_;
  std::vector<Rule> rules_;
};

}  // namespace welkin
