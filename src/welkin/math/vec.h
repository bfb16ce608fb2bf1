#pragma once

#include <array>

#include "welkin/math/scalar.h"

/// @file
/// Vectors of three.
namespace welkin {

/// A vector of three T: a direction when it has unit length. T is double, float or a SIMD pack.
template <class T>
struct Vec3 {
  T x;  ///< right-handed axes (docs/conventions.md)
  T y;  ///< up
  T z;  ///< x × y
};

/// In double: the type of reference functions.
using Vec3d = Vec3<double>;

/// Component by component.
/// @{
template <class T>
Vec3<T> operator+(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
Vec3<T> operator-(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
Vec3<T> operator*(const T& s, const Vec3<T>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
/// @}

/// Scalar product.
template <class T>
T dot(const Vec3<T>& a, const Vec3<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
/// Vector product.
template <class T>
Vec3<T> cross(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// Euclidean length. Squares are formed: of components beyond 1e±19 in float, 1e±154 in double, it is 0 or
/// infinite.
template <class T>
T length(const Vec3<T>& a) {
  return sqrt(dot(a, a));
}
/// The vector of unit length in the direction of `a`, whose length is neither 0 nor infinite.
template <class T>
Vec3<T> normalize(const Vec3<T>& a) {
  return (constant<T>(1.0) / length(a)) * a;
}

}  // namespace welkin
