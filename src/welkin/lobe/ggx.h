#pragma once

#include <vector>

#include "welkin/lobe/angle.h"

namespace welkin::lobe {

/// D(h) · (n·l) with N = V = R, as the split sum of real-time renderers has it; α = roughness². With a = α²
/// and cos²θh = 1 − s/2, D ∝ 1/((a − 1) cos²θh + 1)² = 1/(a + (1 − a) s/2)²; scaled to 1 at the axis this is
/// 1/(1 + k s)² with k = (1 − a)/(2a), and n·l = 1 − s.
struct Ggx {
  static constexpr const char* kName = "ggx";
  static constexpr const char* kDescription = "microfacet reflection as engines pre-filter it, D·(n·l)";
  static constexpr const char* kSource =
      "Trowbridge & Reitz 1975; Walter et al. 2007, eq. 33; N = V = R: Karis 2013";

  double roughness = 0.5;

  template <class Visitor>
  void visit_parameters(Visitor&& visit) {
    visit("roughness", roughness, 0.0, 1.0, "√α; 0 is a mirror");
  }

  bool mirror() const { return roughness < kMirrorRoughness; }
  double steepness() const {
    const double a = roughness * roughness * roughness * roughness;
    return (1 - a) / (2 * a);
  }
  double width() const {
    // (1 + k s)² = 2; the cosine comes in where the lobe is wide.
    return std::min(kPi / 3, angle_of_s((std::numbers::sqrt2 - 1) / std::max(steepness(), 1e-3)));
  }
  std::vector<double> breakpoints() const { return {1}; }

  template <class T>
  T weight(const T& s) const {
    const T one = constant<T>(1);
    const T root = one + constant<T>(steepness()) * s;
    return max(one - s, constant<T>(0)) / (root * root);
  }
};

}  // namespace welkin::lobe
