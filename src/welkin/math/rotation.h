#pragma once

#include <array>
#include <cstddef>

#include "welkin/base/export.h"
#include "welkin/math/vec.h"

namespace welkin {

/// A 3×3 matrix, row by row: a rotation of directions, or a rotation with a reflection (determinant −1).
struct Matrix3 {
  std::array<std::array<double, 3>, 3> rows{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

  friend bool operator==(const Matrix3&, const Matrix3&) = default;
};

WELKIN_API Matrix3 operator*(const Matrix3& a, const Matrix3& b);
WELKIN_API Matrix3 transpose(const Matrix3& a);
WELKIN_API double determinant(const Matrix3& a);

/// True when the rows are orthonormal to within 1e-4: a rotation, or a reflection.
WELKIN_API bool is_orthonormal(const Matrix3& a);

/// Nearest orthonormal matrix to one that is nearly so (Gram–Schmidt, rows in order).
WELKIN_API Matrix3 orthonormalize(const Matrix3& a);

template <class T>
Vec3<T> operator*(const Matrix3& m, const Vec3<T>& v) {
  const auto row = [&](int i) {
    return constant<T>(m.rows[static_cast<std::size_t>(i)][0]) * v.x +
           constant<T>(m.rows[static_cast<std::size_t>(i)][1]) * v.y +
           constant<T>(m.rows[static_cast<std::size_t>(i)][2]) * v.z;
  };
  return {row(0), row(1), row(2)};
}

/// Multiplies `count` vectors by m, in float.
WELKIN_API void multiply(const Matrix3& m, float* x, float* y, float* z, std::size_t count);

/// The rotation that turns the world by `yaw` about +Y, after `pitch` about +X, after `roll` about +Z;
/// degrees, right-handed (positive yaw takes +Z to +X).
WELKIN_API Matrix3 rotation_from_yaw_pitch_roll(double yaw, double pitch, double roll);

/// The rotation of the quaternion w + xi + yj + zk, which need not have unit length (but not zero length).
WELKIN_API Matrix3 rotation_from_quaternion(double w, double x, double y, double z);

}  // namespace welkin
