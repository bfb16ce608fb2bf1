#include <gtest/gtest.h>

#include <cmath>

#include "welkin/math/angles.h"
#include "welkin/synth/synth.h"

namespace welkin::synth {
namespace {

double luminance_at(const Radiance& map, const Vec3d& d) {
  const auto [r, g, b] = map(d);
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}

// Preetham, Shirley & Smits 1999, A.2: Y_z = (4.0453 T − 4.9710) tan χ − 0.2155 T + 2.4192 kcd/m²,
// χ = (4/9 − T/120)(π − 2θ). The matrix to sRGB is rounded to four digits: 1e-3.
TEST(Sky, ZenithHasPreethamsLuminance) {
  for (const double turbidity : {2.5, 3.0, 6.0}) {
    for (const double elevation : {15.0, 40.0, 70.0}) {
      const double chi = (4.0 / 9 - turbidity / 120) * (2 * elevation * kDegree);
      const double expected = (4.0453 * turbidity - 4.9710) * std::tan(chi) - 0.2155 * turbidity + 2.4192;
      const Radiance map = make("sky", {.elevation = elevation, .turbidity = turbidity});
      EXPECT_NEAR(10 * luminance_at(map, {0, 1, 0}) / expected, 1, 1e-3) << turbidity << ' ' << elevation;
    }
  }
}

TEST(Sky, IsFiniteOverTheWholeRangeOfItsOptions) {
  for (const double elevation : {0.0, 1.0, 20.0, 60.0, 90.0}) {
    for (const double turbidity : {2.0, 3.0, 5.0, 10.0}) {
      const Radiance map = make("sky", {.elevation = elevation, .azimuth = 0, .turbidity = turbidity});
      for (int tilt = -90; tilt <= 90; tilt += 5) {
        for (int azimuth = 0; azimuth < 360; azimuth += 10) {
          const double value = luminance_at(map, direction_at(azimuth, tilt));
          EXPECT_TRUE(value > 0 && value < 1e6)
              << elevation << ' ' << turbidity << ' ' << tilt << ' ' << value;
        }
      }
    }
  }
}

TEST(Sky, BrightensTowardTheSun) {
  const Radiance map = make("sky", {.elevation = 30, .azimuth = -70});
  double before = luminance_at(map, direction_at(-70 + 90, 30));
  for (int offset = 85; offset >= 0; offset -= 5) {
    const double now = luminance_at(map, direction_at(-70 + offset, 30));
    EXPECT_GT(now, before) << offset;
    before = now;
  }
  EXPECT_GT(before, 1e4);
}

TEST(Sky, IsBlueAwayFromTheSunAndItsLowSunIsRed) {
  const auto [r, g, b] = make("sky", {.elevation = 40, .azimuth = 0})(direction_at(180, 50));
  EXPECT_GT(b, 1.5f * r);
  EXPECT_GT(b, g);
  const auto [sun_r, sun_g, sun_b] = make("sky", {.elevation = 3, .azimuth = 0})(direction_at(0, 3));
  EXPECT_GT(sun_r, 2 * sun_g);
  EXPECT_GT(sun_g, 2 * sun_b);
}

// A wider disc carries the same sunlight: radiance × solid angle stays. The sky's own part is subtracted.
TEST(Sky, SunlightDoesNotDependOnTheDiscsSize) {
  const Vec3d sun = direction_at(0, 50);
  const auto sunlight = [&](double diameter) {
    const Radiance with = make("sky", {.angle = diameter, .elevation = 50, .azimuth = 0});
    const double sky = luminance_at(with, direction_at(diameter * 0.51 / std::cos(50 * kDegree), 50));
    return (luminance_at(with, sun) - sky) * 2 * kPi * (1 - std::cos(diameter / 2 * kDegree));
  };
  EXPECT_NEAR(sunlight(0.5) / sunlight(2), 1, 1e-3);
}

// Straight down lies the plain: albedo/π times ∫ L cos dω over the upper half of this very map. The midpoint
// rule finds a disc of 20° to 0.3 %.
TEST(Sky, GroundReflectsWhatFallsOnIt) {
  const Radiance map = make("sky", {.angle = 20, .elevation = 60, .albedo = 0.4});
  std::array<double, 3> irradiance{};
  constexpr int kRings = 500, kSpokes = 1000;
  for (int i = 0; i < kRings; ++i) {
    const double level = std::sqrt((i + 0.5) / kRings), y = std::sqrt(1 - level * level);
    for (int j = 0; j < kSpokes; ++j) {
      const double turn = 2 * kPi * (j + 0.5) / kSpokes;
      const auto value = map({level * std::sin(turn), y, level * std::cos(turn)});
      for (std::size_t k = 0; k < 3; ++k) irradiance[k] += value[k] * kPi / (kRings * kSpokes);
    }
  }
  const auto ground = map({0, -1, 0});
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(ground[k] / (0.4 / kPi * irradiance[k]), 1, 5e-3);
}

TEST(Sky, GroundMeetsTheHorizonWithoutAStep) {
  const Radiance map = make("sky");
  for (int azimuth = 0; azimuth < 360; azimuth += 30) {
    const double above = luminance_at(map, direction_at(azimuth, 1e-4));
    EXPECT_NEAR(luminance_at(map, direction_at(azimuth, -1e-4)) / above, 1, 1e-3) << azimuth;
  }
}

}  // namespace
}  // namespace welkin::synth
