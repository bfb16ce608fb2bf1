#include "welkin/lookup/gaussian_taps.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "welkin/lookup/gaussian_kernels.h"

namespace welkin {
namespace {

/// Roots of Hermite's polynomials for the weight exp(−x²/2), and the weights of Gauss's rule (Abramowitz &
/// Stegun 1964, table 25.10, scaled).
struct Hermite {
  std::size_t count;
  double widest;  ///< σ/narrow up to which the sum is within 0.1 % of the Gaussian, in the mean square
  std::array<double, 7> nodes, weights;
};
constexpr Hermite kHermite[] = {
    {3, 0.48, {-1.7320508075688772, 0, 1.7320508075688772}, {1.0 / 6, 2.0 / 3, 1.0 / 6}},
    {4,
     0.66,
     {-2.3344142183389773, -0.7419637843027259, 0.7419637843027259, 2.3344142183389773},
     {0.0458758547680685, 0.4541241452319315, 0.4541241452319315, 0.0458758547680685}},
    {5,
     0.82,
     {-2.8569700138728056, -1.3556261799742659, 0, 1.3556261799742659, 2.8569700138728056},
     {0.0112574113277207, 0.2220759220056126, 0.5333333333333333, 0.2220759220056126, 0.0112574113277207}},
    {6,
     0.97,
     {-3.324257433552119, -1.889175877753711, -0.616706590192594, 0.616706590192594, 1.889175877753711,
      3.324257433552119},
     {0.002555784402056, 0.088615746041914, 0.408828469556029, 0.408828469556029, 0.088615746041914,
      0.002555784402056}},
    {7,
     1.07,
     {-3.750439717725742, -2.366759410734541, -1.154405394739968, 0, 1.154405394739968, 2.366759410734541,
      3.750439717725742},
     {0.000548268855972, 0.030757123967586, 0.240123178605013, 0.457142857142857, 0.240123178605013,
      0.030757123967586, 0.000548268855972}},
};

}  // namespace

int GaussianTapRules::reach_for(double contrast, const GaussianQuality& quality) {
  // A tap at `reach` weighs about exp(−reach²/2) · 0.4 · 0.2; what is as bright as that there is compared
  // with a tenth of the mean.
  const double reach = std::sqrt(2 * std::log(std::max(1.0, 0.8 * contrast / quality.tail)));
  int index = 0;
  while (index + 1 < kReaches && reach_at(index) < reach) ++index;
  return index;
}

GaussianTapRules::GaussianTapRules(const GaussianQuality& quality, double reach)
    : reach_(reach), per_aspect_(static_cast<float>(2 * reach / quality.spacing)) {
  for (std::size_t i = 0; i < widest_.size(); ++i)
    widest_[i] = static_cast<float>(kHermite[i].widest * quality.hermite);
  std::vector<std::size_t> first(kMost + 1);
  for (std::size_t count = 1; count <= kMost; ++count) {
    first[count] = nodes_.size();
    const auto known = std::find_if(std::begin(kHermite), std::end(kHermite),
                                    [&](const Hermite& h) { return h.count == count; });
    std::vector<double> nodes(count), weights(count);
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) {
      if (known != std::end(kHermite)) {
        nodes[i] = known->nodes[i];
        weights[i] = known->weights[i];
      } else {
        nodes[i] = reach_ * ((2.0 * static_cast<double>(i) + 1) / static_cast<double>(count) - 1);
        weights[i] = std::exp(-0.5 * nodes[i] * nodes[i]);
      }
      sum += weights[i];
    }
    for (std::size_t i = 0; i < count; ++i) {
      nodes_.push_back(static_cast<float>(nodes[i]));
      weights_.push_back(static_cast<float>(weights[i] / sum));
    }
  }
  nodes_.resize(nodes_.size() + GaussianTaps::kLanes);
  rules_.resize(kMost + 1);
  for (std::size_t count = 1; count <= kMost; ++count)
    rules_[count] = {count, nodes_.data() + first[count], weights_.data() + first[count]};
}

std::size_t GaussianTapRules::count(float wide, float narrow, float sigma) const {
  for (std::size_t i = 0; i < widest_.size(); ++i) {
    if (sigma <= widest_[i] * narrow) return i + 3;
  }
  // Beyond what an integer holds there is no need to count.
  const float taps = std::min(per_aspect_ * wide / narrow, 1e9f);
  return std::max(std::size_t{8}, static_cast<std::size_t>(taps) + 1);
}

}  // namespace welkin
