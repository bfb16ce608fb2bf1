#include "welkin/measure/statistics.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <limits>

#include "welkin/base/error.h"
#include "welkin/math/angles.h"
#include "welkin/synth/render_synth.h"

namespace welkin {
namespace {

using sphere::AnyParameterization;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

Map constant_map(const std::string& parameterization, int width, int height,
                 const std::vector<float>& texel) {
  Map map(AnyParameterization::make(parameterization), width, height, static_cast<int>(texel.size()));
  for (int chart = 0; chart < map.charts(); ++chart) {
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) std::copy(texel.begin(), texel.end(), map.level.chart(chart).at(x, y));
    }
  }
  return map;
}

/// Whole and half worlds, full charts and discs.
const std::vector<std::string> kSeveral = {"latlong",    "cube",    "angular",
                                           "paraboloid", "healpix", "half-cube"};

TEST(Statistics, AConstantMapHasItsValueEverywhere) {
  for (const std::string& name : kSeveral) {
    const Map map = constant_map(name, 64, 32, {2.0f, 0.5f, 0.25f});
    const MapStatistics s = measure(map);
    const double coverage = map.parameterization.coverage();
    const double luminance = 0.2126 * 2 + 0.7152 * 0.5 + 0.0722 * 0.25;
    ASSERT_EQ(s.channels.size(), 3u) << name;
    EXPECT_EQ(s.channels[1].name, "G");
    for (std::size_t c = 0; c < 3; ++c) {
      const double value = c == 0 ? 2 : c == 1 ? 0.5 : 0.25;
      EXPECT_EQ(s.channels[c].minimum, value) << name;
      EXPECT_EQ(s.channels[c].maximum, value) << name;
      EXPECT_NEAR(s.channels[c].mean, value, 1e-12) << name;
      EXPECT_NEAR(s.channels[c].integral, value * coverage, 1e-9) << name;
    }
    EXPECT_NEAR(s.solid_angle, coverage, 1e-12) << name;
    EXPECT_EQ(s.luminance.minimum, s.luminance.maximum) << name;
    EXPECT_NEAR(s.luminance.mean, luminance, 1e-6) << name;
    EXPECT_NEAR(s.luminance.integral, luminance * coverage, 1e-5) << name;
    EXPECT_EQ(s.luminance.dynamic_range, 0) << name;
    // All of it lies between the smallest and the largest.
    for (const double percentile :
         {s.luminance.percentile_1, s.luminance.percentile_50, s.luminance.percentile_99_9}) {
      EXPECT_EQ(percentile, s.luminance.maximum) << name;
    }
  }
}

TEST(Statistics, OnlyValidTexelsAreCounted) {
  const Map map = constant_map("angular", 200, 200, {1, 1, 1});
  // And those that the rim cuts, half of which have their centres inside.
  EXPECT_NEAR(static_cast<double>(measure(map).texels), kPi / 4 * 200 * 200 + 2 * 200, 50);
}

TEST(Statistics, ValuesThatAreNotNumbersAreCountedAndLeftOut) {
  Map map = constant_map("latlong", 64, 32, {1, 1, 1});
  const ImageView<float> chart = map.level.chart(0);
  chart.at(3, 4)[0] = kNan;
  chart.at(4, 4)[0] = kNan;
  chart.at(5, 4)[1] = kInfinity;
  chart.at(6, 4)[1] = -kInfinity;
  chart.at(7, 9)[2] = -3;
  const MapStatistics s = measure(map);
  EXPECT_EQ(s.channels[0].nan_texels, 2u);
  EXPECT_EQ(s.channels[0].infinite_texels, 0u);
  EXPECT_EQ(s.channels[1].nan_texels, 0u);
  EXPECT_EQ(s.channels[1].infinite_texels, 2u);
  EXPECT_EQ(s.channels[1].negative_texels, 0u);
  EXPECT_EQ(s.channels[2].negative_texels, 1u);
  EXPECT_EQ(s.channels[2].minimum, -3);
  EXPECT_EQ(s.channels[0].mean, 1);
  EXPECT_EQ(s.channels[1].maximum, 1);
  EXPECT_NEAR(s.luminance.minimum, 0.2126 + 0.7152 - 3 * 0.0722, 1e-6);
  EXPECT_EQ(s.texels, 64u * 32u);
}

TEST(Statistics, AMapOfNothingButNanHasNoLight) {
  const MapStatistics s = measure(constant_map("cube", 8, 8, {kNan}));
  EXPECT_EQ(s.channels[0].nan_texels, 6u * 64u);
  EXPECT_EQ(s.channels[0].mean, 0);
  EXPECT_EQ(s.luminance.maximum, 0);
  EXPECT_FALSE(s.light.has_value());
  EXPECT_FALSE(measure(constant_map("cube", 8, 8, {0})).light.has_value());
}

TEST(Statistics, LuminanceGoesByTheNamesOfChannels) {
  Map map = constant_map("cube", 8, 8, {1, 2, 4, 8});
  EXPECT_NEAR(measure(map).luminance.mean, 0.2126 + 2 * 0.7152 + 4 * 0.0722, 1e-6);
  map.channel_names = {"A", "B", "G", "R"};
  EXPECT_NEAR(measure(map).luminance.mean, 8 * 0.2126 + 4 * 0.7152 + 2 * 0.0722, 1e-6);
  map.channel_names = {"Z", "Y", "C2", "C3"};
  EXPECT_EQ(measure(map).luminance.mean, 2);
  map.channel_names = {"depth", "C1", "C2", "C3"};
  EXPECT_EQ(measure(map).luminance.mean, 1);
}

/// With L = exp(10 v) in rows of equal area (v linear in solid angle), the percentile p is exp(10 p/100).
/// Histogram: 1/64; a row: 1/100.
TEST(Statistics, PercentilesAreOfSolidAngle) {
  Map map = constant_map("equal-area", 16, 1000, {0});
  for (int y = 0; y < 1000; ++y) {
    for (int x = 0; x < 16; ++x) map.level.chart(0).at(x, y)[0] = std::exp(static_cast<float>(y) / 100);
  }
  const LuminanceStatistics l = measure(map).luminance;
  EXPECT_NEAR(l.percentile_1 / std::exp(0.1), 1, 0.026);
  EXPECT_NEAR(l.percentile_50 / std::exp(5.0), 1, 0.026);
  EXPECT_NEAR(l.percentile_99 / std::exp(9.9), 1, 0.026);
  EXPECT_NEAR(l.percentile_99_9 / std::exp(9.99), 1, 0.026);
  EXPECT_NEAR(l.dynamic_range, 9.99 / std::log(2.0), 1e-4);
}

TEST(Statistics, PercentilesAmongBlackTexelsAreZero) {
  Map map = constant_map("cube", 16, 16, {0});
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) map.level.chart(2).at(x, y)[0] = 8;
  }
  const LuminanceStatistics l = measure(map).luminance;
  EXPECT_EQ(l.percentile_50, 0);
  EXPECT_EQ(l.percentile_99, 8);
  EXPECT_EQ(l.minimum, 0);
  EXPECT_EQ(l.smallest_positive, 8);
  EXPECT_NEAR(l.mean, 8.0 / 6, 1e-6);
}

TEST(Statistics, TheSunIsFound) {
  synth::SynthOptions options;
  options.angle = 3;
  options.intensity = 1000;
  const Vec3d sun = direction_at(options.azimuth, options.elevation);
  const double solid_angle = 2 * kPi * (1 - std::cos(1.5 * kDegree));
  const double energy = 4 * kPi * 0.1 + (1000 - 0.1) * solid_angle;
  struct Case {
    const char* name;
    int width, height;
  };
  for (const Case& c : {Case{"latlong", 1024, 512}, Case{"cube", 256, 256}, Case{"octahedral", 512, 512},
                        Case{"angular", 512, 512}}) {
    RenderOptions render_options;
    render_options.orientation = rotation_from_yaw_pitch_roll(70, -25, 10);
    const Map map = render(synth::make("sun", options), AnyParameterization::make(c.name), c.width, c.height,
                           render_options);
    const MapStatistics s = measure(map);
    ASSERT_TRUE(s.light.has_value()) << c.name;
    const double texel = std::sqrt(4 * kPi / static_cast<double>(s.texels));
    // The first of equals lies on the disc; the centroid within half a texel of its centre.
    EXPECT_LT(angle_between(s.light->peak_direction, sun), 1.5 * kDegree + texel) << c.name;
    EXPECT_LT(angle_between(s.light->direction, sun), 0.5 * texel) << c.name;
    EXPECT_NEAR(s.light->solid_angle / solid_angle, 1, 0.1) << c.name;
    EXPECT_NEAR(s.light->peak, 1000, 0.01) << c.name;
    // Covered by half or more, mean between a half and the whole.
    EXPECT_GT(s.light->luminance, 900) << c.name;
    EXPECT_NEAR(s.light->radiance[1], s.light->luminance, 0.01) << c.name;
    // What is lost lies in the texels of the rim that the sun covers by less than half.
    const double share = 1000 * solid_angle / energy;
    EXPECT_LT(s.light->share, 1.01 * share) << c.name;
    EXPECT_GT(s.light->share, (1 - 0.7 * texel / (1.5 * kDegree)) * share) << c.name;
    EXPECT_NEAR(s.luminance.integral / energy, 1, 0.02) << c.name;
  }
}

TEST(Statistics, TheLightIsCutOffAtItsReach) {
  const MapStatistics s = measure(constant_map("latlong", 720, 360, {1}));
  ASSERT_TRUE(s.light.has_value());
  EXPECT_NEAR(s.light->solid_angle / (2 * kPi * (1 - std::cos(kLightReach))), 1, 0.02);
  EXPECT_NEAR(s.light->share, s.light->solid_angle / (4 * kPi), 1e-6);
}

TEST(Statistics, ThreadsDoNotChangeAnyDigit) {
  const Map map =
      render(synth::make("lamps"), AnyParameterization::make("latlong"), 512, 256, {.samples = 1});
  MapStatistics one;
  {
    tbb::global_control single(tbb::global_control::max_allowed_parallelism, 1);
    one = measure(map);
  }
  for (int run = 0; run < 5; ++run) {
    const MapStatistics many = measure(map);
    EXPECT_EQ(one.luminance.integral, many.luminance.integral);
    EXPECT_EQ(one.luminance.percentile_99, many.luminance.percentile_99);
    EXPECT_EQ(one.channels[2].mean, many.channels[2].mean);
    EXPECT_EQ(one.light->x, many.light->x);
    EXPECT_EQ(one.light->share, many.light->share);
  }
}

TEST(Statistics, CanBeCancelled) {
  const Map map = constant_map("cube", 16, 16, {1});
  EXPECT_THROW(measure(map, {nullptr, [] { return true; }}), Cancelled);
}

TEST(RenderSynth, TheSunKeepsItsEnergy) {
  synth::SynthOptions options;
  options.angle = 6;
  options.background = 0;
  options.intensity = 1000;
  const double energy = 1000 * 2 * kPi * (1 - std::cos(3 * kDegree));
  for (const char* name : {"latlong", "cube", "octahedral", "angular", "healpix"}) {
    const auto p = AnyParameterization::make(name);
    const int width = p.charts() > 1 ? 128 : 512;
    const Map map = render(synth::make("sun", options), p, width,
                           std::max(1, static_cast<int>(std::lround(width / p.aspect()))));
    EXPECT_NEAR(measure(map).channels[1].integral / energy, 1, 0.01) << name;
  }
}

}  // namespace
}  // namespace welkin
