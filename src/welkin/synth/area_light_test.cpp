#include "welkin/synth/area_light.h"

#include <gtest/gtest.h>

#include "welkin/math/angles.h"

namespace welkin::synth {
namespace {

/// ∫ cos cos' / r² dA over the rectangle, midpoint rule.
double quadrature(const AreaLight& light, const Vec3d& point, const Vec3d& normal) {
  constexpr int kSteps = 400;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      const double x = (2 * (i + 0.5) / kSteps - 1) * light.half_width;
      const double y = (2 * (j + 0.5) / kSteps - 1) * light.half_height;
      const Vec3d to_light = light.centre + x * light.right + y * light.up - point;
      const double r2 = dot(to_light, to_light);
      sum += max(dot(to_light, normal), 0.0) * max(-dot(to_light, light.front), 0.0) / (r2 * r2);
    }
  }
  return sum * light.area() / (kSteps * kSteps);
}

// The quadrature's own error is 1e-5 where the horizon cuts the light, less elsewhere.
TEST(AreaLight, LambertsFormulaIsTheIntegral) {
  const AreaLight light = light_facing_origin(direction_at(30, 20), 2, 1.4, 0.8);
  const Vec3d points[] = {{0, 0, 0}, {0.3, -1, 0.2}, {1.5, 0.1, 0.4}};
  const Vec3d normals[] = {
      {0, 1, 0}, {0, 0, 1}, normalize(Vec3d{-1, 2, 0.5}), normalize(Vec3d{0.3, -0.2, 1})};
  for (const Vec3d& point : points) {
    for (const Vec3d& normal : normals) {
      EXPECT_NEAR(irradiance_from(light, point, normal), quadrature(light, point, normal), 5e-5);
    }
  }
}

TEST(AreaLight, AnEndlessCeilingGivesPi) {
  const AreaLight ceiling{{0, 1, 0}, {1, 0, 0}, {0, 0, 1}, {0, -1, 0}, 1e6, 1e6};
  EXPECT_NEAR(irradiance_from(ceiling, {0, 0, 0}, {0, 1, 0}), kPi, 1e-5);
  // Upright surfaces see half of it.
  EXPECT_NEAR(irradiance_from(ceiling, {0, 0, 0}, {1, 0, 0}), kPi / 2, 1e-5);
}

TEST(AreaLight, ShinesFromItsFrontOnly) {
  const AreaLight light = light_facing_origin({0, 0, 1}, 2, 1, 1);
  EXPECT_EQ(irradiance_from(light, {0, 0, 3}, {0, 0, -1}), 0);
  EXPECT_EQ(irradiance_from(light, {0, 0, 0}, {0, 0, -1}), 0);
  EXPECT_GT(irradiance_from(light, {0, 0, 0}, {0, 0, 1}), 0.2);
}

TEST(AreaLight, RaysMeetItWhereItIs) {
  const AreaLight light = light_facing_origin({0, 0, 1}, 2, 2, 1);
  double x = 0, y = 0;
  // Facing +Z with +Y up, −X is on the right.
  ASSERT_TRUE(hit(light, normalize(Vec3d{-1, 0.5, 2}), x, y));
  EXPECT_NEAR(x, 1, 1e-12);
  EXPECT_NEAR(y, 1, 1e-12);
  EXPECT_FALSE(hit(light, {0, 0, -1}, x, y));
  EXPECT_FALSE(hit(light, {1, 0, 0}, x, y));
}

}  // namespace
}  // namespace welkin::synth
