#include "welkin/synth/synth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <thread>

#include "welkin/base/error.h"
#include "welkin/math/angles.h"

namespace welkin::synth {
namespace {

/// `count` directions spread evenly (a spiral of the golden angle): each stands for 4π/count sr.
std::vector<Vec3d> even_directions(int count) {
  std::vector<Vec3d> all;
  for (int i = 0; i < count; ++i) {
    const double y = 1 - (2 * i + 1.0) / count, turn = i * kPi * (3 - std::sqrt(5.0));
    const double level = std::sqrt(1 - y * y);
    all.push_back({level * std::sin(turn), y, level * std::cos(turn)});
  }
  return all;
}

/// Axes, edges and corners of the cube, exactly and a hair off.
std::vector<Vec3d> awkward_directions() {
  std::vector<Vec3d> all;
  for (int i = 0; i < 27; ++i) {
    const Vec3d d{i % 3 - 1.0, i / 3 % 3 - 1.0, i / 9 - 1.0};
    if (i == 13) continue;
    all.push_back(normalize(d));
    all.push_back(normalize(d + Vec3d{1e-9, -2e-9, 3e-9}));
    all.push_back(normalize(d + Vec3d{-1e-300, 1e-17, -0.0}));
  }
  return all;
}

TEST(Synth, EveryMapIsFiniteAndNotNegative) {
  std::vector<Vec3d> directions = even_directions(100000);
  for (const Vec3d& d : awkward_directions()) directions.push_back(d);
  for (const std::string& name : names()) {
    const Radiance map = make(name);
    int bad = 0;
    float brightest = 0;
    for (const Vec3d& d : directions) {
      for (const float value : map(d)) {
        if (!(value >= 0 && value < std::numeric_limits<float>::infinity())) ++bad;
        brightest = std::max(brightest, value);
      }
    }
    EXPECT_EQ(bad, 0) << name;
    EXPECT_GT(brightest, 0.09f) << name;
  }
}

TEST(Synth, EveryMapHasANameOfItsOwnAndOneLine) {
  const std::vector<std::string> all = names();
  EXPECT_EQ(std::set<std::string>(all.begin(), all.end()).size(), all.size());
  for (const std::string& name : all) {
    EXPECT_FALSE(description(name).empty());
    EXPECT_EQ(description(name).find('\n'), std::string::npos) << name;
  }
}

TEST(Synth, UnknownNameSuggestsTheNearest) {
  EXPECT_THROW(description("skye"), Error);
  try {
    make("skye");
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean 'sky'"), std::string::npos) << error.what();
  }
}

TEST(Synth, OptionsOutOfRangeAreRefused) {
  const auto refused = [](const char* name, const SynthOptions& options) {
    EXPECT_THROW(make(name, options), Error) << name;
  };
  const double nan = std::nan("");
  refused("checker", {.frequency = 35});
  refused("checker", {.frequency = 36.5});
  refused("checker", {.frequency = -2});
  refused("lines", {.frequency = 0.5});
  refused("lines", {.angle = nan});
  refused("zoneplate", {.frequency = -1});
  refused("lamps", {.frequency = 1e7});
  refused("lamps", {.angle = 4});
  refused("sun", {.angle = 361});
  refused("sun", {.elevation = 91});
  refused("sun", {.azimuth = std::numeric_limits<double>::infinity()});
  refused("sun", {.background = -0.1});
  refused("sky", {.elevation = -1});
  refused("sky", {.angle = 1e-3});
  refused("sky", {.turbidity = 1});
  refused("sky", {.albedo = 1.5});
  refused("constant", {.intensity = -1});
  refused("axes", {.intensity = nan});
}

TEST(Synth, IntensityScalesTheWholeMap) {
  for (const char* name : {"axes", "studio", "sky", "room", "checker", "lines", "zoneplate", "constant"}) {
    const Radiance one = make(name), three = make(name, {.intensity = 3});
    for (const Vec3d& d : even_directions(500)) {
      for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(three(d)[i], 3 * one(d)[i], 1e-6 * three(d)[i]) << name;
    }
  }
}

TEST(Synth, ZeroIsAValueAndNoDefault) {
  for (const char* name : {"axes", "studio", "sky", "room", "checker", "lines", "zoneplate", "constant"}) {
    const Radiance black = make(name, {.intensity = 0});
    for (const Vec3d& d : even_directions(500)) EXPECT_EQ(black(d), (std::array<float, 3>{0, 0, 0})) << name;
  }
  const Radiance sun = make("sun", {.intensity = 0, .elevation = 90});
  EXPECT_EQ(sun({0, 1, 0})[0], 0);
  EXPECT_NE(sun({0, -1, 0})[0], 0);
  EXPECT_THROW(make("checker", {.frequency = 0}), Error);
  EXPECT_THROW(make("sky", {.angle = 0}), Error);
}

TEST(Synth, ManyThreadsSeeTheSameMap) {
  const std::vector<Vec3d> directions = even_directions(5000);
  for (const std::string& name : names()) {
    const Radiance map = make(name);
    std::vector<std::array<float, 3>> expected;
    for (const Vec3d& d : directions) expected.push_back(map(d));
    std::vector<std::vector<std::array<float, 3>>> seen(4);
    std::vector<std::thread> threads;
    for (auto& mine : seen) {
      threads.emplace_back([&] {
        for (const Vec3d& d : directions) mine.push_back(map(d));
      });
    }
    for (std::thread& thread : threads) thread.join();
    for (const auto& mine : seen) EXPECT_EQ(mine, expected) << name;
  }
}

TEST(Synth, ConstantIsOneEverywhere) {
  for (const Vec3d& d : awkward_directions()) EXPECT_EQ(make("constant")(d), (std::array<float, 3>{1, 1, 1}));
}

// ∫ (L − background) dω by the midpoint rule in rings about the sun; a ring is 1/2000 of the radius, and only
// the ring on the rim can be wrong: 1e-3.
TEST(Synth, SunHoldsItsEnergy) {
  for (const double diameter : {0.5331, 10.0, 180.0}) {
    const Radiance map = make("sun", {.angle = diameter, .intensity = 5e4, .elevation = -20, .azimuth = 100});
    const double radius = diameter * kDegree / 2, pitch = radius / 2000;
    // Two vectors perpendicular to the sun's direction.
    const Vec3d sun = direction_at(100, -20), side = direction_at(190, 0), up = cross(sun, side);
    double energy = 0;
    for (int ring = 0; ring < 3000; ++ring) {
      const double angle = (ring + 0.5) * pitch;
      const double area = 2 * kPi * (std::cos(ring * pitch) - std::cos((ring + 1) * pitch));
      for (int spoke = 0; spoke < 16; ++spoke) {
        const double turn = 2 * kPi * (spoke + 0.3) / 16;
        const Vec3d d =
            std::cos(angle) * sun + std::sin(angle) * (std::cos(turn) * side + std::sin(turn) * up);
        energy += (map(d)[0] - 0.1) * area / 16;
      }
    }
    const double expected = (5e4 - 0.1) * 2 * kPi * (1 - std::cos(radius));
    EXPECT_NEAR(energy / expected, 1, 1e-3) << diameter;
  }
}

TEST(Synth, CheckerIsHalfLight) {
  const Radiance map = make("checker", {.frequency = 24});
  const std::vector<Vec3d> directions = even_directions(200000);
  double sum = 0;
  for (const Vec3d& d : directions) sum += map(d)[0];
  EXPECT_NEAR(sum / 200000, 0.525, 2e-3);
  EXPECT_EQ(map(direction_at(5, 5))[0], 1.0f);
  EXPECT_EQ(map(direction_at(-5, 5))[0], 0.05f);
  EXPECT_EQ(map(direction_at(-5, -5))[0], 1.0f);
}

// Along a ring between two parallels, N lines of width w cover N·w/(2π cos latitude); the secant of their
// edges adds 1e-4.
TEST(Synth, LinesAreAsWideEverywhere) {
  const Radiance map = make("lines", {.frequency = 12, .angle = 1});
  for (const double latitude : {-40.0, 10.0, 45.0, 80.0}) {
    int lit = 0;
    constexpr int kSamples = 720000;
    for (int i = 0; i < kSamples; ++i) lit += map(direction_at((i + 0.5) * 360 / kSamples, latitude))[0] > 0;
    const double expected = 12.0 / (360 * std::cos(latitude * kDegree));
    EXPECT_NEAR(static_cast<double>(lit) / kSamples / expected, 1, 1.5e-3) << latitude;
  }
}

// Extremes where F θ² = kπ.
TEST(Synth, ZoneplateRingsAreWhereTheirFrequencySays) {
  const Radiance map = make("zoneplate", {.frequency = 20});
  for (int k = 0; k < 62; ++k) {
    const double angle = std::sqrt(k * kPi / 20);
    const Vec3d d{std::sin(angle) * 0.6, std::sin(angle) * 0.8, std::cos(angle)};
    EXPECT_NEAR(map(d)[0], k % 2 == 0 ? 1 : 0, 1e-6) << k;
  }
}

TEST(Synth, LampsFollowTheirSeed) {
  const Radiance a = make("lamps"), again = make("lamps"), b = make("lamps", {.seed = 2});
  int different = 0;
  for (const Vec3d& d : even_directions(50000)) {
    ASSERT_EQ(a(d), again(d));
    different += a(d) != b(d);
  }
  EXPECT_GT(different, 100);
}

// N discs of solid angle ω at random leave e^(−Nω/4π) of the sphere dark; 400,000 samples hit 7,500 times
// (1.2 %, one sigma), and the field of lamps itself varies less.
TEST(Synth, LampsCoverTheirSolidAngleOverAWideRange) {
  const Radiance map = make("lamps", {.frequency = 1000, .angle = 1, .background = 0});
  int lit = 0;
  double dimmest = 1e30, brightest = 0;
  for (const Vec3d& d : even_directions(400000)) {
    const auto [r, g, b] = map(d);
    const double value = 0.2126 * r + 0.7152 * g + 0.0722 * b;
    if (value == 0) continue;
    ++lit;
    dimmest = std::min(dimmest, value);
    brightest = std::max(brightest, value);
  }
  const double solid_angle = 2 * kPi * (1 - std::cos(0.5 * kDegree));
  const double expected = 1 - std::exp(-1000 * solid_angle / (4 * kPi));
  EXPECT_NEAR(lit / 400000.0 / expected, 1, 0.05);
  EXPECT_GE(dimmest, 50 * std::exp(-4.0) * 0.9999);
  EXPECT_LE(brightest, 3 * 50 * std::exp(4.0));
  EXPECT_GT(brightest / dimmest, std::exp(6.0));
}

}  // namespace
}  // namespace welkin::synth
