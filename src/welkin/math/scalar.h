#pragma once

#include <cmath>
#include <concepts>
#include <numbers>

/// @file
/// Functions that double, float and SIMD packs share, so that a formula is written once.
///
/// Generic code calls these unqualified: for double and float they are found here, for an xsimd pack by
/// argument-dependent look-up in xsimd. Everything is branch-free; a comparison gives a mask (bool or a pack
/// of bools) and `select(mask, a, b)` chooses.
namespace welkin {

/// double or float.
template <class T>
concept Scalar = std::floating_point<T>;

/// What a comparison of two T gives: bool, or a pack of bools.
template <class T>
using Mask = decltype(T() < T());

/// As the standard library's function of that name, angles in radians; `select(mask, a, b)` is mask ? a : b.
/// @{
template <Scalar T>
constexpr T select(bool mask, T a, T b) {
  return mask ? a : b;
}
template <Scalar T>
constexpr T min(T a, T b) {
  return b < a ? b : a;
}
template <Scalar T>
constexpr T max(T a, T b) {
  return a < b ? b : a;
}
template <Scalar T>
T abs(T a) {
  return std::fabs(a);
}
template <Scalar T>
T copysign(T magnitude, T sign) {
  return std::copysign(magnitude, sign);
}
template <Scalar T>
T floor(T a) {
  return std::floor(a);
}
template <Scalar T>
T sqrt(T a) {
  return std::sqrt(a);
}
template <Scalar T>
T sin(T a) {
  return std::sin(a);
}
template <Scalar T>
T cos(T a) {
  return std::cos(a);
}
template <Scalar T>
T tan(T a) {
  return std::tan(a);
}
template <Scalar T>
T asin(T a) {
  return std::asin(a);
}
template <Scalar T>
T acos(T a) {
  return std::acos(a);
}
template <Scalar T>
T atan(T a) {
  return std::atan(a);
}
template <Scalar T>
T atan2(T y, T x) {
  return std::atan2(y, x);
}
template <Scalar T>
T exp(T a) {
  return std::exp(a);
}
template <Scalar T>
T log(T a) {
  return std::log(a);
}
/// @}

/// π.
inline constexpr double kPi = std::numbers::pi;

/// A constant of type T from a double: `constant<T>(0.5)` works for packs, whose constructors take their own
/// scalar.
template <class T>
T constant(double value) {
  if constexpr (std::floating_point<T>) {
    return static_cast<T>(value);
  } else {
    return T(static_cast<typename T::value_type>(value));
  }
}

/// ±1 with the sign of `a`, never 0 (octahedra and paraboloids need a side for every direction).
template <class T>
T sign_of(T a) {
  return copysign(constant<T>(1.0), a);
}

/// `a` limited to low…high, low ≤ high.
template <class T>
T clamp(T a, T low, T high) {
  return min(max(a, low), high);
}

}  // namespace welkin
