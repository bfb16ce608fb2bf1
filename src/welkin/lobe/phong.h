#pragma once

#include <limits>
#include <vector>

#include "welkin/lobe/angle.h"

namespace welkin::lobe {

/// max(cos θ, 0)^exponent about the reflected ray. Its roughness is ρ = 1/exponent, so that a chain over ρ is
/// Lo(r) = ks ∫ L(l) (r·l)^(1/ρ) dω; ρ = 0, exponent infinite, is a mirror, and ρ = 1 the Lambert lobe.
struct Phong {
  static constexpr const char* kName = "phong";
  static constexpr const char* kDescription = "cosine power about the reflected ray; roughness is 1/exponent";
  static constexpr const char* kSource = "Phong 1975; Heidrich & Seidel 1999";

  double exponent = 50;

  template <class Visitor>
  void visit_parameters(Visitor&& visit) {
    visit("exponent", exponent, 0.0, std::numeric_limits<double>::infinity(), "of cos θ; inf is a mirror");
  }
  template <class Visitor>
  void visit_synonyms(Visitor&& visit) {
    const double before = 1 / exponent;
    double roughness = before;
    visit("roughness", roughness, 0.0, 1.0, "1/exponent; 0 is a mirror");
    if (roughness != before) exponent = 1 / roughness;
  }

  bool mirror() const { return exponent > 1e15; }
  double width() const { return angle_of_s(-std::expm1(-std::numbers::ln2 / exponent)); }

  /// At the horizon cos^n is smooth for whole n alone; for others the panels shrink toward it.
  std::vector<double> breakpoints() const {
    std::vector<double> list;
    if (exponent < 20 && exponent != std::floor(exponent)) {
      for (double below = 0.25; below > 1e-14; below /= 4) list.push_back(1 - below);
    }
    list.push_back(1);
    return list;
  }

  template <class T>
  T weight(const T& s) const {
    return select(s < constant<T>(1), power_below_one(s, exponent), constant<T>(0));
  }
};

}  // namespace welkin::lobe
