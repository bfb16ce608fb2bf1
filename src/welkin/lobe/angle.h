#pragma once

#include <algorithm>
#include <cmath>

#include "welkin/math/scalar.h"

/// What the lobes share: angles θ and s = 1 − cos θ, and powers of numbers just below 1.
namespace welkin::lobe {

/// Unqualified calls find this for double and float, and xsimd's own for packs: see math/scalar.h.
template <Scalar T>
T log1p(T a) {
  return std::log1p(a);
}

inline double s_of_angle(double angle) {
  const double half_sine = std::sin(0.5 * angle);
  return 2 * half_sine * half_sine;
}

inline double angle_of_s(double s) {
  return 2 * std::asin(std::sqrt(std::clamp(0.5 * s, 0.0, 1.0)));
}

/// (1 − x)^exponent for 0 ≤ x < 1, of full relative precision however small x is. Elsewhere the result is
/// unspecified. Relative error in float: 2e-7 times the exponent's logarithm of the result, and 2e-7.
template <class T>
T power_below_one(const T& x, double exponent) {
  // No 1 − x above zero has a logarithm under −50; the limit keeps 0 · ∞ away.
  return exp(constant<T>(exponent) * max(log1p(-x), constant<T>(-50)));
}

/// Roughness below which a lobe of α = roughness² is given as a mirror: narrower than 1e-7 radians, it cannot
/// be told from one by directions of floats.
inline constexpr double kMirrorRoughness = 1e-4;

}  // namespace welkin::lobe
