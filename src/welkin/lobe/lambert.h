#pragma once

#include <vector>

#include "welkin/lobe/angle.h"

namespace welkin::lobe {

/// max(cos θ, 0), of integral π: what a diffuse surface facing the axis receives.
struct Lambert {
  static constexpr const char* kName = "lambert";
  static constexpr const char* kDescription = "diffuse surfaces: irradiance over π";
  static constexpr const char* kSource = "Lambert 1760";

  bool mirror() const { return false; }
  double width() const { return kPi / 3; }
  std::vector<double> breakpoints() const { return {1}; }

  template <class T>
  T weight(const T& s) const {
    return max(constant<T>(1) - s, constant<T>(0));
  }
};

}  // namespace welkin::lobe
