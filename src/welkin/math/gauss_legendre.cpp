#include "welkin/math/gauss_legendre.h"

#include <array>
#include <cassert>
#include <cmath>
#include <mutex>

#include "welkin/math/scalar.h"

namespace welkin {
namespace {

/// P_n(x) and its derivative.
struct Polynomial {
  double value, slope;
};
Polynomial legendre(int n, double x) {
  double before = 1, value = x;
  for (int l = 1; l < n; ++l) {
    const double next = ((2 * l + 1) * x * value - l * before) / (l + 1);
    before = value;
    value = next;
  }
  return {value, n * (x * value - before) / (x * x - 1)};
}

}  // namespace

QuadratureRule gauss_legendre(int count) {
  assert(count >= 2);
  QuadratureRule rule;
  for (int i = 0; i < count; ++i) {
    double x = -std::cos(kPi * (i + 0.75) / (count + 0.5));
    for (int step = 0; step < 6; ++step) {
      const Polynomial p = legendre(count, x);
      x -= p.value / p.slope;
    }
    const double slope = legendre(count, x).slope;
    rule.nodes.push_back(x);
    rule.weights.push_back(2 / ((1 - x * x) * slope * slope));
  }
  return rule;
}

const QuadratureRule& gauss_rule(int count) {
  constexpr std::size_t kSlots = kMostGaussNodes + 1;
  static std::array<std::once_flag, kSlots> made;
  static std::array<QuadratureRule, kSlots> rules;
  assert(count >= 2 && count <= kMostGaussNodes);
  const auto slot = static_cast<std::size_t>(count);
  std::call_once(made[slot], [&] { rules[slot] = gauss_legendre(count); });
  return rules[slot];
}

}  // namespace welkin
