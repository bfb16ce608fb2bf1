#pragma once

#include <cmath>
#include <initializer_list>

#include "welkin/brdf/brdf.h"
#include "welkin/math/scalar.h"

namespace welkin::fuzz {

/// What was read must have values that can be added up, everywhere above the surface.
inline void look_up_everywhere(const brdf::AnyBrdf& brdf) {
  const auto direction = [](double theta, double phi) {
    return Vec3d{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
  };
  for (const double view : {0.0, 0.3, 1.0, kPi / 2 - 1e-6}) {
    for (const double light : {0.0, 0.7, kPi / 2 - 1e-6}) {
      for (const double around : {0.0, 1.0, kPi}) {
        const double value = brdf.value(direction(view, 0), direction(light, around));
        if (!(value >= 0) || !std::isfinite(value)) __builtin_trap();
      }
    }
  }
  static_cast<void>(brdf.width());
  static_cast<void>(brdf.notes());
}

}  // namespace welkin::fuzz
