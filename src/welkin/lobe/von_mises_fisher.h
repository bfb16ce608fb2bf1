#pragma once

#include <vector>

#include "welkin/lobe/angle.h"

namespace welkin::lobe {

/// exp(−κ s) = exp(κ (cos θ − 1)), over the whole sphere: the normal distribution's counterpart there. κ = 0
/// is the mean of the sphere; for large κ a Gaussian of σ = 1/√κ radians.
struct VonMisesFisher {
  static constexpr const char* kName = "vmf";
  static constexpr const char* kDescription = "von Mises–Fisher: a Gaussian on the sphere, smooth everywhere";
  static constexpr const char* kSource = "Fisher 1953";

  double kappa = 50;

  template <class Visitor>
  void visit_parameters(Visitor&& visit) {
    visit("kappa", kappa, 0.0, 1e8, "concentration κ; σ is about 1/√κ radians");
  }

  bool mirror() const { return false; }
  double width() const { return kappa > 0.5 ? angle_of_s(std::numbers::ln2 / kappa) : kPi / 2; }
  std::vector<double> breakpoints() const { return {}; }

  template <class T>
  T weight(const T& s) const {
    return exp(constant<T>(-kappa) * s);
  }
};

}  // namespace welkin::lobe
