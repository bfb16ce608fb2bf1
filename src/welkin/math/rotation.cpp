#include "welkin/math/rotation.h"

#include <cmath>

namespace welkin {

Matrix3 operator*(const Matrix3& a, const Matrix3& b) {
  Matrix3 product;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      product.rows[i][j] = 0;
      for (std::size_t k = 0; k < 3; ++k) product.rows[i][j] += a.rows[i][k] * b.rows[k][j];
    }
  }
  return product;
}

Matrix3 transpose(const Matrix3& a) {
  Matrix3 t;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) t.rows[i][j] = a.rows[j][i];
  }
  return t;
}

namespace {

Vec3d row_of(const Matrix3& a, std::size_t i) {
  return {a.rows[i][0], a.rows[i][1], a.rows[i][2]};
}

}  // namespace

double determinant(const Matrix3& a) {
  return dot(row_of(a, 0), cross(row_of(a, 1), row_of(a, 2)));
}

bool is_orthonormal(const Matrix3& a) {
  const Matrix3 identity;
  const Matrix3 gram = a * transpose(a);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      if (!(std::fabs(gram.rows[i][j] - identity.rows[i][j]) < 1e-4)) return false;
    }
  }
  return true;
}

Matrix3 orthonormalize(const Matrix3& a) {
  const Vec3d x = normalize(row_of(a, 0));
  const Vec3d y = normalize(row_of(a, 1) - dot(row_of(a, 1), x) * x);
  Vec3d z = cross(x, y);
  if (determinant(a) < 0) z = -1.0 * z;
  return {{{{x.x, x.y, x.z}, {y.x, y.y, y.z}, {z.x, z.y, z.z}}}};
}

Matrix3 rotation_from_yaw_pitch_roll(double yaw, double pitch, double roll) {
  const double degree = kPi / 180;
  const double cy = std::cos(yaw * degree), sy = std::sin(yaw * degree);
  const double cp = std::cos(pitch * degree), sp = std::sin(pitch * degree);
  const double cr = std::cos(roll * degree), sr = std::sin(roll * degree);
  const Matrix3 about_y{{{{cy, 0, sy}, {0, 1, 0}, {-sy, 0, cy}}}};
  const Matrix3 about_x{{{{1, 0, 0}, {0, cp, -sp}, {0, sp, cp}}}};
  const Matrix3 about_z{{{{cr, -sr, 0}, {sr, cr, 0}, {0, 0, 1}}}};
  return about_y * about_x * about_z;
}

Matrix3 rotation_from_quaternion(double w, double x, double y, double z) {
  const double s = 2 / (w * w + x * x + y * y + z * z);
  return {{{{1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)},
            {s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x)},
            {s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y)}}}};
}

void multiply(const Matrix3& m, float* x, float* y, float* z, std::size_t count) {
  float f[3][3];
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) f[i][j] = static_cast<float>(m.rows[i][j]);
  }
  for (std::size_t i = 0; i < count; ++i) {
    const float a = x[i], b = y[i], c = z[i];
    x[i] = f[0][0] * a + f[0][1] * b + f[0][2] * c;
    y[i] = f[1][0] * a + f[1][1] * b + f[1][2] * c;
    z[i] = f[2][0] * a + f[2][1] * b + f[2][2] * c;
  }
}

}  // namespace welkin
