#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

/// Tables of integrals over the hemisphere, by equal steps of √(n·v), and linear between them.
namespace welkin::scene {

/// A step before a place in 0 … 1, and how far the place is from it to the next.
struct Between {
  int first;
  double part;
};
/// `place` is clamped; there are two steps at least, at 0 and 1.
inline Between between(double place, int steps) {
  const double x = std::clamp(place, 0.0, 1.0) * (steps - 1);
  const int first = std::min(static_cast<int>(x), steps - 2);
  return {first, x - first};
}

/// What each step counts in the mean over the hemisphere, 2 ∫ … μ dμ, exactly. With x = √μ, 2 μ dμ = 4 x³ dx;
/// between two steps the integrand is a polynomial of degree 4, for which Gauss's rule of three points is
/// exact.
inline std::vector<double> hemisphere_weights(int steps) {
  constexpr double kNodes[3] = {0.1127016653792583, 0.5, 0.8872983346207417};
  constexpr double kWeights[3] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
  std::vector<double> weights(static_cast<std::size_t>(steps));
  for (std::size_t i = 0; i + 1 < weights.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      const double x = (static_cast<double>(i) + kNodes[k]) / (steps - 1);
      const double weight = 4 * x * x * x * kWeights[k] / (steps - 1);
      weights[i] += (1 - kNodes[k]) * weight;
      weights[i + 1] += kNodes[k] * weight;
    }
  }
  return weights;
}

}  // namespace welkin::scene
