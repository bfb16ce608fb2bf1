#pragma once

#include <random>

#include "welkin/harmonics/harmonics.h"

/// What the tests of harmonics share.
namespace welkin::harmonics::cases {

inline Vec3d random_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  const double x = normal(random), y = normal(random), z = normal(random);
  return normalize(Vec3d{x, y, z});
}

/// Normally distributed coefficients.
inline SphericalHarmonics random_harmonics(int degree, int channels, std::mt19937& random) {
  std::normal_distribution<double> normal;
  SphericalHarmonics result(degree, channels);
  for (double& value : result.values()) value = normal(random);
  return result;
}

/// The largest |a − b| of a coefficient over the norm of b.
inline double relative_error(const SphericalHarmonics& a, const SphericalHarmonics& b) {
  double largest = 0;
  for (std::size_t i = 0; i < b.values().size(); ++i)
    largest = std::max(largest, std::fabs(a.values()[i] - b.values()[i]));
  return largest / b.norm();
}

}  // namespace welkin::harmonics::cases
