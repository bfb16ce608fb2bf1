#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

/// Linear R G B in double, of sums over many paths.
namespace welkin::scene {

using Radiance = std::array<double, 3>;

/// Channel by channel.
/// @{
inline Radiance operator+(const Radiance& a, const Radiance& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Radiance operator*(const Radiance& a, const Radiance& b) {
  return {a[0] * b[0], a[1] * b[1], a[2] * b[2]};
}
inline Radiance operator*(double a, const Radiance& b) {
  return {a * b[0], a * b[1], a * b[2]};
}
/// @}

inline Radiance to_radiance(const std::array<float, 3>& rgb) {
  return {rgb[0], rgb[1], rgb[2]};
}
inline double largest(const Radiance& value) {
  return std::max({value[0], value[1], value[2]});
}
inline double mean(const Radiance& value) {
  return (value[0] + value[1] + value[2]) / 3;
}

}  // namespace welkin::scene
