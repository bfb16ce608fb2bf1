#pragma once

#include <limits>
#include <vector>

#include "welkin/lobe/angle.h"

namespace welkin::lobe {

/// (n·h)^exponent · (n·l) with N = V = R: h halves the angle, so n·h = cos(θ/2), (n·h)² = 1 − s/2, and n·l =
/// cos θ. The exponent is 2/α² − 2 with α = roughness², which matches GGX and Beckmann of the same α at the
/// peak.
struct Blinn {
  static constexpr const char* kName = "blinn";
  static constexpr const char* kDescription = "half-vector cosine power times n·l, for N = V = R";
  static constexpr const char* kSource =
      "Blinn 1977; exponent: Walter et al. 2007, sec. 5.2, with α = roughness² of Karis 2013";

  double roughness = 0.5;

  template <class Visitor>
  void visit_parameters(Visitor&& visit) {
    visit("roughness", roughness, 0.0, 1.0, "√α; 0 is a mirror");
  }
  template <class Visitor>
  void visit_synonyms(Visitor&& visit) {
    const double before = exponent();
    double given = before;
    visit("exponent", given, 0.0, std::numeric_limits<double>::infinity(),
          "2/roughness⁴ − 2; inf is a mirror");
    if (given != before) roughness = std::pow(2 / (given + 2), 0.25);
  }

  double exponent() const { return 2 / (roughness * roughness * roughness * roughness) - 2; }

  bool mirror() const { return roughness < kMirrorRoughness; }
  double width() const {
    return std::min(kPi / 3, angle_of_s(-2 * std::expm1(-2 * std::numbers::ln2 / exponent())));
  }
  std::vector<double> breakpoints() const { return {1}; }

  template <class T>
  T weight(const T& s) const {
    const T zero = constant<T>(0), one = constant<T>(1);
    return select(s < one, power_below_one(constant<T>(0.5) * s, 0.5 * exponent()) * (one - s), zero);
  }
};

}  // namespace welkin::lobe
