#include "welkin/brdf/azimuth_rule.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>

#include "welkin/brdf/graded_rule.h"
#include "welkin/math/scalar.h"

namespace welkin::brdf {
namespace {

/// σ = 2⁻ᵏ; narrower functions are of no account (dfg.cpp).
constexpr int kRules = 100;

AzimuthRule make_rule(int k) {
  AzimuthRule rule;
  for_graded_nodes(kPi, std::ldexp(2.0, -k), [&](double psi, double weight) {
    const double sine = std::sin(0.5 * psi);
    rule.sine_squared.push_back(sine * sine);
    rule.weights.push_back(weight);
  });
  return rule;
}

}  // namespace

const AzimuthRule& azimuth_rule(double sigma) {
  static std::array<std::once_flag, kRules> made;
  static std::array<AzimuthRule, kRules> rules;
  const int k = std::clamp(static_cast<int>(std::ceil(-std::log2(std::max(sigma, 1e-300)))), 0, kRules - 1);
  const auto slot = static_cast<std::size_t>(k);
  std::call_once(made[slot], [&] { rules[slot] = make_rule(k); });
  return rules[slot];
}

}  // namespace welkin::brdf
