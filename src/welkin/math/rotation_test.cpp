#include "welkin/math/rotation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace welkin {
namespace {

void expect_near(const Matrix3& a, const Matrix3& b, double tolerance) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) EXPECT_NEAR(a.rows[i][j], b.rows[i][j], tolerance);
  }
}

TEST(Rotation, YawTakesZToXPitchTakesYToZRollTakesXToY) {
  const Vec3d x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  EXPECT_LT(length(rotation_from_yaw_pitch_roll(90, 0, 0) * z - x), 1e-15);
  EXPECT_LT(length(rotation_from_yaw_pitch_roll(0, 90, 0) * y - z), 1e-15);
  EXPECT_LT(length(rotation_from_yaw_pitch_roll(0, 0, 90) * x - y), 1e-15);
}

TEST(Rotation, QuaternionsAreRotationsAndScaleDoesNotMatter) {
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 100; ++i) {
    const double w = normal(random), x = normal(random), y = normal(random), z = normal(random);
    const Matrix3 m = rotation_from_quaternion(w, x, y, z);
    EXPECT_TRUE(is_orthonormal(m));
    EXPECT_NEAR(determinant(m), 1, 1e-12);
    expect_near(m, rotation_from_quaternion(-3 * w, -3 * x, -3 * y, -3 * z), 1e-12);
    expect_near(m * transpose(m), Matrix3{}, 1e-12);
  }
  // Half a turn about +Y.
  const Vec3d turned = rotation_from_quaternion(0, 0, 1, 0) * Vec3d{1, 2, 3};
  EXPECT_LT(length(turned - Vec3d{-1, 2, -3}), 1e-15);
}

TEST(Rotation, OrthonormalizeKeepsHandednessAndRemovesRoundingErrors) {
  for (const double side : {1.0, -1.0}) {
    Matrix3 m = rotation_from_yaw_pitch_roll(20, 30, 40);
    for (double& value : m.rows[0]) value *= side;
    Matrix3 rounded = m;
    for (auto& row : rounded.rows) {
      for (double& value : row) value = std::round(value * 1e5) / 1e5;
    }
    const Matrix3 repaired = orthonormalize(rounded);
    EXPECT_NEAR(determinant(repaired), side, 1e-12);
    expect_near(repaired * transpose(repaired), Matrix3{}, 1e-12);
    expect_near(repaired, m, 2e-5);
  }
  EXPECT_FALSE(is_orthonormal(Matrix3{{{{1, 0, 0}, {0, 2, 0}, {0, 0, 1}}}}));
}

}  // namespace
}  // namespace welkin
