#include "welkin/measure/energy.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <limits>

#include "welkin/base/error.h"
#include "welkin/filter/resample.h"
#include "welkin/map/adjust.h"
#include "welkin/map/borders.h"
#include "welkin/math/angles.h"
#include "welkin/measure/statistics.h"
#include "welkin/synth/render_synth.h"

namespace welkin {
namespace {

using sphere::AnyParameterization;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// The default size of a map that is as fine as a lat-long of this width.
Map like(const Map& source, const std::string& spec) {
  const auto p = AnyParameterization::make(spec);
  const ChartSize size = default_chart_size(source, p);
  Map map(p, size.width, size.height, source.channels());
  map.channel_names = source.channel_names;
  return map;
}

Map converted(const Map& source, const std::string& spec, Filter filter = Filter::automatic,
              const Matrix3& rotation = {}, const Matrix3& orientation = {}) {
  Map map = like(source, spec);
  map.orientation = orientation;
  ResampleOptions options;
  options.filter = filter;
  options.rotation = rotation;
  resample(source, map, options);
  return map;
}

struct Lamp {
  Vec3d direction;
  double radius;
  float radiance;
};

/// Lamps before a background, each texel by 4×4 points.
Map lamps(const std::string& spec, int width, int height, const std::vector<Lamp>& list, float background,
          const Matrix3& orientation = {}) {
  const auto world = [&](const Vec3d& d) -> std::array<float, 3> {
    float value = background;
    for (const Lamp& lamp : list) {
      if (dot(d, normalize(lamp.direction)) >= std::cos(lamp.radius)) value += lamp.radiance;
    }
    return {value, value, value / 2};
  };
  return render(world, AnyParameterization::make(spec), width, height,
                {.samples = 4, .orientation = orientation});
}

constexpr double kSunRadius = 0.53 / 2 * kDegree;

/// Channels R and G of 1 and B of a half.
constexpr double kLuminance = 0.2126 + 0.7152 + 0.0722 / 2;

TEST(Energy, AConstantMapHasItsValueTimesTheCoverageAndNoLight) {
  for (const char* name : {"latlong", "cube", "angular", "paraboloid", "healpix", "half-cube"}) {
    const Map map = lamps(name, 64, 64, {}, 3);
    const MapEnergy energy = measure_energy(map);
    const double coverage = map.parameterization.coverage();
    ASSERT_EQ(energy.channels, (std::vector<std::string>{"R", "G", "B"}));
    EXPECT_NEAR(energy.whole.channels[0] / (3 * coverage), 1, 1e-6) << name;
    EXPECT_NEAR(energy.whole.channels[2] / (1.5 * coverage), 1, 1e-6) << name;
    EXPECT_NEAR(energy.whole.luminance / (3 * kLuminance * coverage), 1, 1e-6) << name;
    EXPECT_TRUE(energy.lights.empty()) << name;
  }
}

TEST(Energy, ASunHasItsOwnWhereverItLies) {
  for (const char* name : {"latlong", "cube", "octahedral", "healpix", "angular"}) {
    const auto p = AnyParameterization::make(name);
    const int width = p.charts() > 1 ? 128 : 512;
    const int height = static_cast<int>(std::lround(width / p.aspect()));
    for (const Vec3d& where : {direction_at(20, 37), Vec3d{0, 1, 0}, Vec3d{1, 1, 1}, Vec3d{0.01, 0.02, -1}}) {
      const double radius = 2 * kDegree, solid_angle = 2 * kPi * (1 - std::cos(radius));
      const MapEnergy energy = measure_energy(lamps(name, width, height, {{where, radius, 1000}}, 0));
      ASSERT_EQ(energy.lights.size(), 1u) << name;
      const LightEnergy& sun = energy.lights[0];
      EXPECT_LT(angle_between(sun.light.direction, where), 0.1 * kDegree) << name;
      // Drawn by 4×4 points in a texel, which are off by up to 2.2 %.
      EXPECT_NEAR(sun.energy.luminance / (1000 * kLuminance * solid_angle), 1, 0.03) << name;
      EXPECT_NEAR(sun.energy.channels[1] / (1000 * solid_angle), 1, 0.03) << name;
      // On the creases of an octahedron the whole is less exact.
      EXPECT_NEAR(sun.energy.luminance / energy.whole.luminance, 1, 2e-4) << name;
      EXPECT_NEAR(sun.share, 1, 2e-4) << name;
      EXPECT_NEAR(sun.light.solid_angle / solid_angle, 1, 0.15) << name;
      EXPECT_GT(sun.light.radius, radius);
      EXPECT_LT(sun.light.radius, radius + 2.5 * kDegree) << name;
    }
  }
}

TEST(Energy, TheWholeIsWhatStatisticsSay) {
  const Map map = lamps("octahedral", 100, 100, {{{1, 2, 3}, 0.2, 10}}, 0.5f);
  const MapStatistics statistics = measure(map);
  const MapEnergy energy = measure_energy(map);
  EXPECT_NEAR(energy.whole.luminance / statistics.luminance.integral, 1, 1e-6);
  EXPECT_NEAR(energy.whole.channels[2] / statistics.channels[2].integral, 1, 1e-6);
}

TEST(Energy, LightsStandOutAndApart) {
  // Three lamps, a fourth too dim, a fifth beside a brighter one, and a glow about the first.
  const Vec3d first = direction_at(0, 10), second = direction_at(90, 0), third = direction_at(180, -40);
  const std::vector<Lamp> list = {{first, 1 * kDegree, 1000},
                                  {second, 2 * kDegree, 500},
                                  {third, 3 * kDegree, 200},
                                  {direction_at(-90, 0), 2 * kDegree, 0.5f},
                                  {direction_at(93, 0), 0.6 * kDegree, 100}};
  Map map = lamps("latlong", 720, 360, list, 1);
  for (int y = 0; y < 360; ++y) {
    for (int x = 0; x < 720; ++x) {
      const Vec3d d = map.parameterization.to_sphere(0, (x + 0.5) / 720, (y + 0.5) / 360);
      const double glow = 50 * std::exp(-angle_between(d, first) / (8 * kDegree));
      for (int c = 0; c < 3; ++c) map.level.chart(0).at(x, y)[c] += static_cast<float>(glow);
    }
  }
  for (const int count : {0, 1, 3, 10}) {
    const MapEnergy energy = measure_energy(map, {.lights = count});
    ASSERT_EQ(energy.lights.size(), static_cast<std::size_t>(std::min(count, 3)));
    if (count < 3) continue;
    EXPECT_LT(angle_between(energy.lights[0].light.direction, first), 0.1 * kDegree);
    EXPECT_LT(angle_between(energy.lights[1].light.direction, second), 0.1 * kDegree);
    // Its brightest texel lies at its edge, and its far side beyond kLightReach.
    EXPECT_LT(angle_between(energy.lights[2].light.direction, third), 0.5 * kDegree);
    EXPECT_GT(energy.lights[0].light.peak, energy.lights[1].light.peak);
  }
}

TEST(Energy, ConversionsThatKeepLightHaveARatioOfOne) {
  for (const int width : {512, 1024, 2048}) {
    const Map sun = lamps("latlong", width, width / 2, {{direction_at(20, 37), kSunRadius, 60000}}, 0.3f);
    const EnergyComparison c = compare_energy(sun, converted(sun, "cube"));
    EXPECT_NEAR(c.solid_angle, 4 * kPi, 1e-9);
    EXPECT_LT(c.change_of_whole(), 1e-3) << width;
    ASSERT_EQ(c.lights.size(), 1u) << width;
    EXPECT_NEAR(c.lights[0].change.ratio, 1, 1e-3) << width;
    EXPECT_LT(c.change_of_lights(), 1e-3) << width;
    const double energy = 60000 * kLuminance * 2 * kPi * (1 - std::cos(kSunRadius));
    EXPECT_NEAR(c.lights[0].change.before.luminance / energy, 1, 0.05) << width;
  }
}

TEST(Energy, ALightThatGainsIsSeenToGain) {
  const Map sun = lamps("latlong", 512, 256, {{direction_at(20, 37), kSunRadius, 60000}}, 0.3f);
  const MapEnergy alone = measure_energy(sun);
  for (const float gain : {0.5f, 0.99f, 1.25f, 2.0f}) {
    Map cube = converted(sun, "cube");
    for (int chart = 0; chart < 6; ++chart) {
      for (int y = 0; y < cube.height(); ++y) {
        for (int i = 0; i < cube.width() * 3; ++i) {
          float& value = cube.level.chart(chart).row(y)[i];
          if (value > 10) value *= gain;
        }
      }
    }
    const EnergyComparison c = compare_energy(sun, cube);
    ASSERT_EQ(c.lights.size(), 1u);
    // Some of it lies on texels of less than 10, and the sky within the cone doesn't gain.
    EXPECT_NEAR(c.lights[0].change.ratio, static_cast<double>(gain), 5e-3);
    const double share = alone.lights[0].share;
    EXPECT_NEAR(c.whole.ratio, 1 + share * (static_cast<double>(gain) - 1), 5e-3);
  }
}

TEST(Energy, InterpolationAtCentresIsNotAMean) {
  const Map sun = lamps("latlong", 512, 256, {{direction_at(20, 37), kSunRadius, 60000}}, 0);
  for (const Filter filter : {Filter::nearest, Filter::bilinear, Filter::bicubic, Filter::lanczos}) {
    const EnergyComparison c = compare_energy(sun, converted(sun, "cube", filter));
    ASSERT_EQ(c.lights.size(), 1u);
    // Without a sky, the light is all there is.
    EXPECT_NEAR(c.lights[0].change.ratio, c.whole.ratio, 2e-3) << name_of(filter);
  }
  EXPECT_GT(compare_energy(sun, converted(sun, "cube", Filter::lanczos)).change_of_lights(), 0.01);
}

TEST(Energy, ConesLieInTheWorld) {
  const Matrix3 turned = rotation_from_yaw_pitch_roll(50, 20, -70);
  const Matrix3 mirrored = Matrix3{{{{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}} * turned;
  const std::vector<Lamp> list = {{direction_at(20, 37), 3 * kDegree, 1000},
                                  {direction_at(-140, -25), 4 * kDegree, 700}};
  for (const char* from : {"latlong", "octahedral"}) {
    for (const Matrix3& first : {Matrix3{}, turned, mirrored}) {
      const Map a = lamps(from, 200, from[0] == 'l' ? 100 : 200, list, 0.2f, first);
      for (const Matrix3& second : {Matrix3{}, mirrored}) {
        for (const Matrix3& rotation : {Matrix3{}, turned}) {
          const Map b = converted(a, "cube", Filter::automatic, rotation, second);
          const EnergyComparison c = compare_energy(a, b, {.rotation = rotation});
          ASSERT_EQ(c.lights.size(), 2u);
          EXPECT_LT(angle_between(c.lights[0].light.direction, list[0].direction), 0.5 * kDegree);
          // What a conversion between maps of 200 texels keeps; a cone that missed would be off by all.
          EXPECT_LT(c.change_of_whole(), 2e-3);
          EXPECT_LT(c.change_of_lights(), 3e-3);
        }
      }
    }
  }
}

TEST(Energy, OnlyWhatBothShowIsCompared) {
  const std::vector<Lamp> list = {{direction_at(10, 20), 3 * kDegree, 1000},
                                  {{0, 0.2, -1}, 3 * kDegree, 2000}};
  const Map a = lamps("latlong", 512, 256, list, 0.5f);
  for (const char* part : {"fisheye-equidistant", "half-cube", "paraboloid", "cylinder"}) {
    const Map b = converted(a, part);
    const double coverage = b.parameterization.coverage();
    for (const bool forth : {true, false}) {
      const EnergyComparison c = forth ? compare_energy(a, b) : compare_energy(b, a);
      EXPECT_NEAR(c.solid_angle / std::min(coverage, 4 * kPi), 1, 1e-3) << part;
      EXPECT_LT(c.change_of_whole(), 3e-3) << part << forth;
      EXPECT_LT(c.change_of_lights(), 3e-3) << part << forth;
    }
  }
  // The brighter light isn't shown by a hemisphere.
  const EnergyComparison c = compare_energy(a, converted(a, "fisheye-equidistant"));
  ASSERT_EQ(c.lights.size(), 2u);
  EXPECT_EQ(c.lights[0].change.before.luminance, 0);
  EXPECT_EQ(c.lights[0].change.ratio, 1);
  EXPECT_GT(c.lights[1].change.before.luminance, 1);
}

TEST(Energy, SignedAndMissingValues) {
  Map a = lamps("cube", 32, 32, {}, 1);
  Map b = a.clone();
  for (Map* each : {&a, &b}) {
    for (int y = 0; y < 32; ++y) {
      for (int i = 0; i < 32 * 3; ++i) each->level.chart(0).row(y)[i] = -1;
      for (int i = 0; i < 32 * 3; ++i) each->level.chart(1).row(y)[i] = -1;
      for (int i = 0; i < 32 * 3; ++i) each->level.chart(2).row(y)[i] = each == &a ? -1.0f : -1.5f;
    }
  }
  // Six faces of 1, half of them negative in R: nothing as a sum, and a twelfth of |before| less afterwards.
  const EnergyComparison c = compare_energy(a, b);
  EXPECT_NEAR(c.whole.before.channels[0], 0, 1e-4);
  EXPECT_NEAR(c.whole.ratios[0], 1 - 0.5 / 6, 1e-5);

  Map holes = a.clone();
  holes.level.chart(3).at(4, 5)[1] = kNan;
  EXPECT_EQ(measure_energy(holes).skipped, 1u);
  EXPECT_TRUE(std::isfinite(measure_energy(holes).whole.luminance));
  EXPECT_EQ(compare_energy(holes, holes).skipped, 2u);
  EXPECT_EQ(compare_energy(holes, holes).change_of_whole(), 0);

  const Map black(AnyParameterization::make("cube"), 16, 16, 3);
  EXPECT_EQ(compare_energy(black, black).whole.ratio, 1);
  EXPECT_EQ(compare_energy(black, holes).change_of_whole(), std::numeric_limits<double>::infinity());
}

TEST(Energy, ChannelsGoByNameAndAlphaIsNone) {
  Map a(AnyParameterization::make("cube"), 8, 8, 4), b(AnyParameterization::make("cube"), 8, 8, 3);
  b.channel_names = {"B", "G", "R"};
  for (int chart = 0; chart < 6; ++chart) {
    for (int y = 0; y < 8; ++y) {
      for (int x = 0; x < 8; ++x) {
        for (int c = 0; c < 4; ++c) a.level.chart(chart).at(x, y)[c] = static_cast<float>(c + 1);
        for (int c = 0; c < 3; ++c) b.level.chart(chart).at(x, y)[c] = static_cast<float>(3 - c);
      }
    }
  }
  EXPECT_EQ(measure_energy(a).channels, (std::vector<std::string>{"R", "G", "B"}));
  const EnergyComparison c = compare_energy(a, b);
  EXPECT_EQ(c.channels, (std::vector<std::string>{"R", "G", "B"}));
  EXPECT_NEAR(c.whole.after.channels[2], 3 * 4 * kPi, 1e-4);
  EXPECT_LT(c.change_of_whole(), 1e-9);
  b.channel_names = {"X", "Y", "Z"};
  EXPECT_THROW(compare_energy(a, b), Error);
}

TEST(Energy, RowsMayComeInAnyOrderAndTwice) {
  const Map sun = lamps("latlong", 128, 64, {{direction_at(20, 37), 3 * kDegree, 100}}, 0.3f);
  const Map cube = converted(sun, "cube", Filter::bicubic);
  const EnergyComparison whole = compare_energy(sun, cube);
  EnergyMeter meter(sun, cube, cube.channel_names);
  for (int chart = 5; chart >= 0; --chart) {
    for (int y = cube.height(); y > 0; --y) {
      if (chart > 0) {
        EXPECT_THROW(meter.comparison(), Error);
      }
      const int first = std::max(0, y - 3);
      meter.add(chart, first, cube.level.chart(chart).part(0, first, cube.width(), y - first));
    }
  }
  const EnergyComparison rows = meter.comparison();
  EXPECT_EQ(rows.whole.ratio, whole.whole.ratio);
  EXPECT_EQ(rows.lights[0].change.after.channels, whole.lights[0].change.after.channels);
  EXPECT_THROW(meter.add(6, 0, cube.level.chart(0).part(0, 0, cube.width(), 1)), Error);
  EXPECT_THROW(meter.add(0, cube.height(), cube.level.chart(0).part(0, 0, cube.width(), 1)), Error);
  EXPECT_THROW(meter.add(0, 0, cube.level.chart(0).part(0, 0, 3, 1)), Error);
}

TEST(Energy, ThreadsChangeNothingAndItCanBeCancelled) {
  const Map sun = lamps("latlong", 128, 64, {{direction_at(20, 37), 3 * kDegree, 100}}, 0.3f);
  const Map cube = converted(sun, "cube");
  const EnergyComparison many = compare_energy(sun, cube);
  const tbb::global_control single(tbb::global_control::max_allowed_parallelism, 1);
  const EnergyComparison one = compare_energy(sun, cube);
  EXPECT_EQ(many.whole.after.channels, one.whole.after.channels);
  EXPECT_EQ(many.lights[0].change.before.luminance, one.lights[0].change.before.luminance);
  EXPECT_THROW(compare_energy(sun, cube, {.monitor = {nullptr, [] { return true; }}}), Cancelled);
  EXPECT_THROW(measure_energy(sun, {.monitor = {nullptr, [] { return true; }}}), Cancelled);
}

TEST(Energy, TinyMaps) {
  for (const char* name : {"latlong", "cube", "octahedral", "angular"}) {
    for (const int side : {1, 2, 3}) {
      Map map(AnyParameterization::make(name), side, side, 3);
      map.level.chart(0).at(side / 2, side / 2)[1] = 5;
      fill_borders(map);
      const EnergyComparison c = compare_energy(map, map);
      EXPECT_EQ(c.change_of_whole(), 0) << name << side;
      EXPECT_EQ(c.change_of_lights(), 0) << name << side;
      EXPECT_NEAR(measure_energy(map).whole.channels[1], measure(map).channels[1].integral, 1e-5) << name;
    }
  }
}

}  // namespace
}  // namespace welkin
