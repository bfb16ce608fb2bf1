#include "welkin/lookup/elliptical_weights.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "welkin/base/cpu.h"
#include "welkin/lookup/tangent_plane.h"
#include "welkin/math/vec_precision.h"

namespace welkin::test {
namespace {

/// Against float64, at distances up to the antipode.
void compare(WeighDirections weigh) {
  std::mt19937 random(6);
  std::normal_distribution<double> along;
  const TangentPlane plane(normalize(Vec3d{0.3, -0.5, 0.8}));
  for (const double sigma : {0.01, 0.1, 0.7, 3.0}) {
    const double aspect = 3, wide = aspect * sigma;
    const EllipticalWeight weight{to_float(plane.normal),
                                  to_float(plane.right),
                                  to_float(plane.down),
                                  static_cast<float>(1 / (wide * wide)),
                                  0,
                                  static_cast<float>(1 / (sigma * sigma)),
                                  4};
    alignas(64) std::array<float, 64> x, y, z, weights;
    for (int round = 0; round < 50; ++round) {
      std::array<double, 64> want;
      for (std::size_t i = 0; i < 64; ++i) {
        const PlanePoint at{std::fmin(3, wide) * along(random), std::fmin(3, sigma) * along(random)};
        const Vec3<float> d = to_float(plane.exponential(at));
        x[i] = d.x;
        y[i] = d.y;
        z[i] = d.z;
        const PlanePoint p = plane.logarithm(
            normalize(Vec3d{static_cast<double>(d.x), static_cast<double>(d.y), static_cast<double>(d.z)}));
        const double distance = p.x * p.x / (wide * wide) + p.y * p.y / (sigma * sigma);
        want[i] = distance <= 16 ? std::exp(-0.5 * distance) : 0;
        // At the very end a weight may be counted or not, and by the antipode the plane's axes turn fast.
        if (std::fabs(distance - 16) < 1e-2 || p.x * p.x + p.y * p.y > 9) want[i] = -1;
      }
      weigh(weight, x.data(), y.data(), z.data(), weights.data(), 64);
      for (std::size_t i = 0; i < 64; ++i) {
        if (want[i] < 0) continue;
        // Directions are off by 1e-7, weights by that over σ.
        EXPECT_NEAR(static_cast<double>(weights[i]), want[i], 2e-5) << sigma << " " << i;
      }
    }
  }
}

TEST(WeighDirections, IsNearFloat64) {
  compare(weigh_directions_baseline());
#ifdef WELKIN_HAS_AVX2
  if (instruction_set() == InstructionSet::avx2) compare(weigh_directions_avx2());
#endif
}

}  // namespace
}  // namespace welkin::test
