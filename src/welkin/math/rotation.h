#pragma once

#include <array>
#include <cstddef>

#include "welkin/base/export.h"
#include "welkin/math/vec.h"

/// @file
/// Rotations and reflections of directions.
namespace welkin {

/// A 3×3 matrix, row by row: a rotation of directions, or a rotation with a reflection (determinant −1).
struct Matrix3 {
  /// rows[i][j]: row i, column j. Default: identity.
  std::array<std::array<double, 3>, 3> rows{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

  /// Element by element, exactly.
  friend bool operator==(const Matrix3&, const Matrix3&) = default;
};

/// The product: b first, then a.
WELKIN_API Matrix3 operator*(const Matrix3& a, const Matrix3& b);
/// Of an orthonormal matrix, its inverse.
WELKIN_API Matrix3 transpose(const Matrix3& a);
/// 1 of a rotation, −1 of a reflection.
WELKIN_API double determinant(const Matrix3& a);

/// True when the rows are orthonormal to within 1e-4: a rotation, or a reflection.
WELKIN_API bool is_orthonormal(const Matrix3& a);

/// The orthonormal matrix of one that is nearly so, by Gram–Schmidt: the first row keeps its direction, the
/// second the plane of the first two. Rows must be linearly independent.
WELKIN_API Matrix3 orthonormalize(const Matrix3& a);

/// m applied to a vector.
template <class T>
Vec3<T> operator*(const Matrix3& m, const Vec3<T>& v) {
  const auto row = [&](int i) {
    return constant<T>(m.rows[static_cast<std::size_t>(i)][0]) * v.x +
           constant<T>(m.rows[static_cast<std::size_t>(i)][1]) * v.y +
           constant<T>(m.rows[static_cast<std::size_t>(i)][2]) * v.z;
  };
  return {row(0), row(1), row(2)};
}

/// Replaces `count` vectors (x[i], y[i], z[i]) by m times them, in float. The arrays don't overlap.
WELKIN_API void multiply(const Matrix3& m, float* x, float* y, float* z, std::size_t count);

/// The rotation that turns the world by `yaw` about +Y, after `pitch` about +X, after `roll` about +Z;
/// degrees, right-handed (positive yaw takes +Z to +X).
WELKIN_API Matrix3 rotation_from_yaw_pitch_roll(double yaw, double pitch, double roll);

/// The rotation of the quaternion w + xi + yj + zk, which need not have unit length (but not zero length).
WELKIN_API Matrix3 rotation_from_quaternion(double w, double x, double y, double z);

}  // namespace welkin
