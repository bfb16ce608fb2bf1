#pragma once

#include <vector>

#include "welkin/lobe/angle.h"

namespace welkin::lobe {

/// Sheen: sin(θh)^(1/α) · (n·l) with N = V = R, θh = θ/2 and α = roughness², as glTF has it. sin²(θ/2) = s/2,
/// so the weight is s^(1/2α) (1 − s), but for a factor. It is 0 on the axis and largest on a ring, which
/// narrows toward the horizon as the roughness falls: there is no mirror, and 0.01 is the smallest roughness.
struct Charlie {
  static constexpr const char* kName = "charlie";
  static constexpr const char* kDescription =
      "sheen of cloth, D·(n·l): 0 on the axis, largest on a ring near the horizon";
  static constexpr const char* kSource = "Estevez & Kulla 2017; α = roughness²: glTF KHR_materials_sheen";

  double roughness = 0.5;

  template <class Visitor>
  void visit_parameters(Visitor&& visit) {
    visit("roughness", roughness, 0.01, 1.0, "√α; the lobe vanishes at 0");
  }

  bool mirror() const { return false; }
  double exponent() const { return 0.5 / (roughness * roughness); }
  /// Of the ring: s^p (1 − s) is above half its largest within about 1.2/p of that for large p.
  double width() const { return std::min(kPi / 3, 1.2 / exponent()); }

  /// The panels shrink toward the horizon as far as the ring does.
  std::vector<double> breakpoints() const {
    std::vector<double> list;
    for (double below = 0.5; below * exponent() > 0.5; below /= 2) list.push_back(1 - below);
    list.push_back(1);
    return list;
  }

  template <class T>
  T weight(const T& s) const {
    const T zero = constant<T>(0), one = constant<T>(1);
    const T power = exp(constant<T>(exponent()) * log(s));
    return select((s > zero) & (s < one), power * (one - s), zero);
  }
};

}  // namespace welkin::lobe
