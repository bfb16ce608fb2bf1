#include "welkin/math/gauss_legendre.h"

#include <cassert>
#include <cmath>

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

}  // namespace welkin
