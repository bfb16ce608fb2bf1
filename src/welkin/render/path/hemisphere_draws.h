#pragma once

#include <algorithm>
#include <cmath>

#include "welkin/math/vec.h"

/// Directions about +z from two numbers in [0, 1), and their probabilities per solid angle.
namespace welkin::scene {

/// A direction of density cos/π, by equal areas of the disc (Shirley & Chiu 1997).
inline Vec3d cosine_direction(double u1, double u2) {
  const double a = 2 * u1 - 1, b = 2 * u2 - 1;
  double r = 0, phi = 0;
  if (std::abs(a) > std::abs(b)) {
    r = a;
    phi = kPi / 4 * (b / a);
  } else if (b != 0) {
    r = b;
    phi = kPi / 2 - kPi / 4 * (a / b);
  }
  return {r * std::cos(phi), r * std::sin(phi), std::sqrt(std::max(1e-12, 1 - r * r))};
}

/// A direction near the horizon, where smooth facets hide each other: its cosine is a uniform number's
/// square.
inline Vec3d grazing_direction(double u1, double u2) {
  const double z = std::max(1e-12, u1 * u1), s = std::sqrt((1 - z) * (1 + z)), phi = 2 * kPi * u2;
  return {s * std::cos(phi), s * std::sin(phi), z};
}
/// What is scattered more than once: half of it evenly, half near the horizon.
inline Vec3d often_direction(double u, double u1, double u2) {
  return u < 0.5 ? cosine_direction(u1, u2) : grazing_direction(u1, u2);
}
inline double often_density(double cosine) {
  return cosine / (2 * kPi) + 1 / (8 * kPi * std::sqrt(cosine));
}

}  // namespace welkin::scene
