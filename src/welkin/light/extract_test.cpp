#include "welkin/light/extract.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <limits>
#include <random>
#include <string>
#include <vector>

#include "welkin/base/error.h"
#include "welkin/light/light_cases.h"
#include "welkin/map/map_cases.h"
#include "welkin/map/texel_grid.h"
#include "welkin/synth/render_synth.h"
#include "welkin/synth/synth.h"

namespace welkin {
namespace {

using namespace cases;

constexpr double kSun = kSunDiameter * kDegree;

/// A sky of radiance 1, coloured, brighter toward +Y, so that nothing is even.
Map sky(const std::string& spec, int size, int channels = 3) {
  return rendered(
      spec, size, [](const Vec3d& d) { return 0.4 + 0.1 * d.y; }, channels);
}

/// Of every channel, to 1e-6: sums of solid angles in float, in another order.
void expect_energy_kept(const Map& map, const Extraction& extraction, const std::vector<float>& omega) {
  const std::vector<double> before = energy_of(map, omega), after = energy_of(extraction.residual, omega);
  for (std::size_t c = 0; c < extraction.found.channels.size(); ++c) {
    double lights = 0;
    for (const ExtractedLight& each : extraction.found.lights) lights += each.irradiance[c] / each.restored;
    EXPECT_NEAR((after[c] + lights) / before[c], 1, 1e-6) << extraction.found.channels[c];
    EXPECT_NEAR(extraction.residual_energy[c] / after[c], 1, 1e-6);
    EXPECT_NEAR(extraction.energy[c] / before[c], 1, 1e-6);
  }
}
void expect_energy_kept(const Map& map, const Extraction& extraction) {
  expect_energy_kept(map, extraction, solid_angles_of(map));
}

/// Nowhere negative, nowhere above the map.
void expect_between(const Map& map, const Map& residual, const std::vector<float>& omega) {
  for (std::size_t i = 0; i < omega.size(); ++i) {
    if (!(omega[i] > 0)) continue;
    const TexelGrid::Place place = TexelGrid(map).place(static_cast<TexelGrid::Index>(i));
    for (int c = 0; c < map.channels(); ++c) {
      const float value = residual.level.chart(place.chart).at(place.x, place.y)[c];
      ASSERT_GE(value, 0);
      ASSERT_LE(value, map.level.chart(place.chart).at(place.x, place.y)[c]);
    }
  }
}

class LightsOfEveryParameterization : public ::testing::TestWithParam<std::string> {};

/// At the poles, on the date line, on edges and corners of charts, anywhere: a sun of about six texels lies
/// where it is, with its energy and its size. A texel is 1° on average; texels of thousands of times that, as
/// at the rim of a mirror ball, are left out.
TEST_P(LightsOfEveryParameterization, FindsASunWhereverItLies) {
  const std::vector<Vec3d> places{{0, 1, 0},   {0, -1, 0},       {0, 0, -1},        {0, 0, 1},
                                  {1, 1, 1},   {1, 0, 1},        {-1, -1, 0.001},   {1, 0.002, 0},
                                  {-1, 1, -1}, {0.3, -0.4, 0.7}, {-0.01, 0.2, -1.0}};
  const Map empty = sky(GetParam(), GetParam().starts_with("latlong,") ? 96 : 160);
  const std::vector<float> omega = solid_angles_of(empty);
  const double sky_energy = energy_of(empty, omega)[0];
  int found = 0;
  for (const Vec3d& place : places) {
    SCOPED_TRACE(testing::Message() << place.x << " " << place.y << " " << place.z);
    const Disc disc{normalize(place), 6 * kDegree, 5000};
    if (!empty.parameterization.covers(empty.orientation * disc.direction)) continue;
    Map map = empty.clone();
    add_disc(map, disc, {1, 0.9, 0.7}, 16);
    const double added = energy_of(map, omega)[0] - sky_energy;
    const Extraction extraction = extract_lights(map);
    expect_energy_kept(map, extraction, omega);
    expect_between(map, extraction.residual, omega);
    // What the map shows of the disc, at its end, or where its texels are as large as the disc.
    if (std::fabs(added / disc.irradiance() - 1) > 0.02) continue;
    ASSERT_EQ(extraction.found.lights.size(), 1u);
    const ExtractedLight& sun = extraction.found.lights.front();
    EXPECT_LT(angle_between(sun.direction, disc.direction), 0.15 * kDegree);
    EXPECT_NEAR(sun.irradiance[0] / added, 1, 0.002);
    EXPECT_NEAR(sun.irradiance[2] / sun.irradiance[0], 0.7, 0.001);
    if (sun.shape == LightShape::point) {
      EXPECT_GT(sun.solid_angle / disc.solid_angle(), 0.94);
    } else {
      EXPECT_NEAR(sun.solid_angle / disc.solid_angle(), 1, 0.06);
    }
    EXPECT_LT(largest_value(extraction.residual, omega), 5);
    ++found;
  }
  EXPECT_GE(found, empty.parameterization.whole_world() ? 8 : 0);
}
INSTANTIATE_TEST_SUITE_P(Light, LightsOfEveryParameterization, ::testing::ValuesIn(names_and_windows()),
                         test_name);

/// The sun as cameras see it, 1.5 texels across: direction to a seventh of a texel, irradiance to what
/// samples make of the disc's edge.
TEST(ExtractLights, MeasuresASunOfTheRealSize) {
  const Map empty = rendered(
      "latlong", 724, [](const Vec3d&) { return 1; }, 3);
  ASSERT_EQ(empty.width(), 1024);
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 8; ++i) {
    const Disc disc{normalize(Vec3d{normal(random), normal(random), normal(random)}), kSun, 1e5};
    Map map = empty.clone();
    add_disc(map, disc, {1, 1, 1}, 96);
    const Extraction extraction = extract_lights(map);
    expect_energy_kept(map, extraction);
    ASSERT_EQ(extraction.found.lights.size(), 1u);
    const ExtractedLight& sun = extraction.found.lights.front();
    EXPECT_LT(angle_between(sun.direction, disc.direction), 0.05 * kDegree);
    EXPECT_NEAR(sun.irradiance[1] / disc.irradiance(), 1, 0.002);
    if (sun.shape == LightShape::point) {
      EXPECT_GT(sun.solid_angle, disc.solid_angle());
    } else {
      EXPECT_NEAR(sun.solid_angle / disc.solid_angle(), 1, 0.05);
    }
    EXPECT_LT(largest_value(extraction.residual), 3.1);
  }
}

TEST(ExtractLights, TwoSunsAreTwo) {
  const Vec3d first = normalize(Vec3d{0.3, 0.5, -1}), aside = normalize(cross(first, {0, 1, 0}));
  for (const double apart : {1.5, 3.0, 20.0, 120.0}) {
    SCOPED_TRACE(apart);
    Map map = rendered(
        "latlong", 724, [](const Vec3d&) { return 1; }, 3);
    const Disc one{first, kSun, 1e5},
        two{std::cos(apart * kDegree) * first + std::sin(apart * kDegree) * aside, kSun, 5e4};
    add_disc(map, one);
    add_disc(map, two, {1, 0.5, 0.25});
    const Extraction extraction = extract_lights(map);
    expect_energy_kept(map, extraction);
    ASSERT_EQ(extraction.found.lights.size(), 2u);
    EXPECT_LT(angle_between(extraction.found.lights[0].direction, one.direction), 0.06 * kDegree);
    EXPECT_LT(angle_between(extraction.found.lights[1].direction, two.direction), 0.06 * kDegree);
    EXPECT_NEAR(extraction.found.lights[0].irradiance[0] / one.irradiance(), 1, 0.01);
    EXPECT_NEAR(extraction.found.lights[1].irradiance[0] / two.irradiance(), 1, 0.01);

    const Extraction strongest = extract_lights(map, {.most = 1});
    ASSERT_EQ(strongest.found.lights.size(), 1u);
    EXPECT_EQ(strongest.found.lights[0].irradiance, extraction.found.lights[0].irradiance);
    EXPECT_GT(largest_value(strongest.residual), 1e4);
  }
}

TEST(ExtractLights, AClippedSunIsToldAndRestored) {
  Map map = sky("latlong", 300);
  add_disc(map, {normalize(Vec3d{1, 1, 0}), 6 * kDegree, 5000}, {1, 0.9, 0.8});
  const double whole = extract_lights(map).found.lights.at(0).luminance;
  for (int y = 0; y < map.height(); ++y) {
    float* row = map.level.chart(0).row(y);
    for (int i = 0; i < map.width() * 3; ++i) row[i] = std::min(row[i], 100.0f);
  }
  fill_borders(map);
  const Extraction clipped = extract_lights(map);
  ASSERT_EQ(clipped.found.lights.size(), 1u);
  EXPECT_TRUE(clipped.found.lights[0].flat_topped());
  EXPECT_LT(clipped.found.lights[0].luminance, whole / 10);
  const Extraction restored = extract_lights(map, {.sun_irradiance = whole});
  EXPECT_NEAR(restored.found.lights[0].luminance / whole, 1, 1e-12);
  EXPECT_NEAR(restored.found.lights[0].restored * clipped.found.lights[0].luminance / whole, 1, 1e-12);
  EXPECT_EQ(largest_difference(restored.residual, clipped.residual), 0);
  expect_energy_kept(map, restored);
}

/// A window of 20° × 10°, tilted: an ellipse of its moments, half axes 2/√12 of its sides, has π/3 of its
/// area.
TEST(ExtractLights, ALampOfManyTexelsIsOneEllipse) {
  const Vec3d front = normalize(Vec3d{0.2, 0.3, 1}), up = normalize(cross(front, {1, 0.5, 0})),
              right = cross(up, front);
  const double width = std::tan(10 * kDegree), height = std::tan(5 * kDegree);
  for (const char* spec : {"latlong", "cube", "octahedral"}) {
    SCOPED_TRACE(spec);
    const Map map = rendered(
        spec, 300,
        [&](const Vec3d& d) {
          const double depth = dot(d, front);
          const bool lit =
              depth > 0 && std::fabs(dot(d, right)) < width * depth && std::fabs(dot(d, up)) < height * depth;
          return lit ? 50 + 10 * d.x : 0.5;
        },
        3);
    const Extraction extraction = extract_lights(map);
    expect_energy_kept(map, extraction);
    ASSERT_EQ(extraction.found.lights.size(), 1u);
    const ExtractedLight& lamp = extraction.found.lights.front();
    EXPECT_LT(angle_between(lamp.direction, front), 0.3 * kDegree);
    EXPECT_EQ(lamp.shape, LightShape::ellipse);
    EXPECT_NEAR(lamp.half_axes[0] / (40 / std::sqrt(12.0) * kDegree), 1, 0.03);
    EXPECT_NEAR(lamp.half_axes[1] / (20 / std::sqrt(12.0) * kDegree), 1, 0.03);
    EXPECT_GT(std::fabs(dot(lamp.axis, right)), 0.999);
    EXPECT_NEAR(dot(lamp.axis, lamp.direction), 0, 1e-9);
    EXPECT_LT(largest_value(extraction.residual), 0.51 * 3);
  }
}

TEST(ExtractLights, OneTexelIsAPointOfAtMostItsSize) {
  Map map = sky("latlong", 100);
  float* texel = map.level.chart(0).at(40, 30);
  std::fill_n(texel, 3, 1e6f);
  fill_borders(map);
  const Extraction extraction = extract_lights(map);
  ASSERT_EQ(extraction.found.lights.size(), 1u);
  const ExtractedLight& sun = extraction.found.lights.front();
  std::vector<float> omega(static_cast<std::size_t>(map.width()));
  texel_solid_angles(map.parameterization, map.width(), map.height(), 0, 30, omega.data());
  EXPECT_EQ(sun.shape, LightShape::point);
  EXPECT_LT(sun.solid_angle, 1.1 * static_cast<double>(omega[40]));
  EXPECT_NEAR(sun.irradiance[0] / (1e6 * static_cast<double>(omega[40])), 1, 1e-4);
  EXPECT_LT(angle_between(sun.direction, direction_at(map, 0, 40, 30)), 1e-6);
  EXPECT_FALSE(sun.flat_topped());
}

TEST(ExtractLights, NothingStandsOutOfBlackEvenAndTinyMaps) {
  for (const double value : {0.0, 3.0}) {
    const Map map = rendered(
        "latlong", 20, [&](const Vec3d&) { return value; }, 3);
    const Extraction extraction = extract_lights(map);
    EXPECT_TRUE(extraction.found.lights.empty());
    EXPECT_EQ(largest_difference(extraction.residual, map), 0);
    EXPECT_EQ(extraction.residual_energy, extraction.energy);
  }
  Map one(sphere::AnyParameterization::make("latlong"), 1, 1, 3);
  std::fill_n(one.level.chart(0).at(0, 0), 3, 5.0f);
  EXPECT_TRUE(extract_lights(one).found.lights.empty());
  EXPECT_TRUE(extract_lights(sky("cube", 16), {.most = 0}).found.lights.empty());
}

TEST(ExtractLights, ALightAtTheEndOfAPartIsMarked) {
  Map map = sky("latlong,left=-90,right=90,top=45,bottom=-45", 200);
  const auto at = [](double azimuth, double elevation) { return welkin::direction_at(azimuth, elevation); };
  add_disc(map, {at(90, 0), 6 * kDegree, 5000}, {1, 1, 1}, 8);
  add_disc(map, {at(0, 10), 4 * kDegree, 5000}, {1, 1, 1}, 8);
  const Extraction extraction = extract_lights(map);
  ASSERT_EQ(extraction.found.lights.size(), 2u);
  EXPECT_TRUE(extraction.found.lights[0].cut);
  EXPECT_FALSE(extraction.found.lights[1].cut);
  EXPECT_NEAR(extraction.shown, map.parameterization.coverage(), 1e-4);
}

TEST(ExtractLights, ChannelsAreNamedAndAlphaStays) {
  Map map = sky("cube", 64, 4);
  ASSERT_EQ(map.channel_names.back(), "A");
  add_disc(map, {normalize(Vec3d{1, 2, 3}), 10 * kDegree, 1000}, {1, 1, 1}, 4);
  const Extraction extraction = extract_lights(map);
  EXPECT_EQ(extraction.found.channels, (std::vector<std::string>{"R", "G", "B"}));
  ASSERT_EQ(extraction.found.lights.size(), 1u);
  expect_energy_kept(map, extraction);
  EXPECT_NEAR(energy_of(extraction.residual)[3], energy_of(map)[3], 1e-9);

  Map grey = sky("cube", 64, 1);
  add_disc(grey, {normalize(Vec3d{1, 2, 3}), 10 * kDegree, 1000}, {1, 1, 1}, 4);
  const LightSet of_grey = extract_lights(grey).found;
  EXPECT_EQ(of_grey.rgb(0)[2], of_grey.lights.at(0).irradiance[0]);
  Map other = sky("cube", 64, 5);
  add_disc(other, {normalize(Vec3d{1, 2, 3}), 10 * kDegree, 1000}, {1, 1, 1}, 4);
  const LightSet of_other = extract_lights(other).found;
  EXPECT_THROW(of_other.rgb(0), Error);
  EXPECT_THROW(of_grey.rgb(1), Error);
}

TEST(ExtractLights, DirectionsAreOfTheWorld) {
  Map map = sky("cube", 64);
  map.orientation = rotation_from_yaw_pitch_roll(30, 40, 50);
  const Vec3d direction = normalize(Vec3d{1, 2, 3});
  add_disc(map, {direction, 10 * kDegree, 1000}, {1, 1, 1}, 4);
  EXPECT_LT(angle_between(extract_lights(map).found.lights.at(0).direction, direction), 0.2 * kDegree);
}

TEST(ExtractLights, RefusesWhatItCannotMeasure) {
  Map map = sky("latlong", 20);
  map.level.chart(0).at(3, 3)[1] = std::numeric_limits<float>::quiet_NaN();
  try {
    extract_lights(map);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::bad_value);
  }
  const Map good = sky("latlong", 20);
  EXPECT_NE(refusal([&] { extract_lights(good, {.most = -1}); }), "done");
  EXPECT_NE(refusal([&] { extract_lights(good, {.above = 1}); }), "done");
  EXPECT_NE(refusal([&] { extract_lights(good, {.sun_irradiance = 0.0}); }), "done");
  EXPECT_THROW(extract_lights(good, {.monitor = {nullptr, [] { return true; }}}), Cancelled);
}

/// Thousands of lamps: those that are asked for, the strongest first, and the same whatever the threads.
TEST(ExtractLights, TheStrongestOfManyOnAnyNumberOfThreads) {
  const Map map = render(synth::make("lamps"), sphere::AnyParameterization::make("latlong"), 512, 256);
  const Extraction extraction = extract_lights(map, {.most = 40, .above = 3});
  ASSERT_EQ(extraction.found.lights.size(), 40u);
  expect_energy_kept(map, extraction);
  expect_between(map, extraction.residual, solid_angles_of(map));
  for (std::size_t i = 1; i < 40; ++i)
    EXPECT_GE(extraction.found.lights[i - 1].luminance, extraction.found.lights[i].luminance);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const Extraction again = extract_lights(map, {.most = 40, .above = 3});
  for (std::size_t i = 0; i < 40; ++i) {
    EXPECT_EQ(again.found.lights[i].irradiance, extraction.found.lights[i].irradiance);
    EXPECT_EQ(again.found.lights[i].direction.x, extraction.found.lights[i].direction.x);
  }
  EXPECT_EQ(largest_difference(again.residual, extraction.residual), 0);
}

}  // namespace
}  // namespace welkin
