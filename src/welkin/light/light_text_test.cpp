#include "welkin/light/light_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "welkin/base/error.h"
#include "welkin/math/angles.h"
#include "welkin/math/rotation.h"

namespace welkin {
namespace {

/// One light along `direction`, R 2, G 4, B 1, a disc of that diameter.
LightSet light_along(const Vec3d& direction, double degrees) {
  ExtractedLight light;
  light.direction = direction;
  light.irradiance = {2, 4, 1};
  light.shape = LightShape::disc;
  light.solid_angle = 2 * kPi * (1 - std::cos(degrees / 2 * kDegree));
  return {{"R", "G", "B"}, {light}};
}

std::string text_of(const char* name, const LightSet& set, double unit = 1) {
  return light_text(light_format_from_name(name), set, unit);
}

/// The numbers after `before` in a text.
template <std::size_t kCount>
std::array<double, kCount> numbers_after(const std::string& text, const std::string& before) {
  std::array<double, kCount> numbers{};
  std::size_t at = text.find(before);
  EXPECT_NE(at, std::string::npos) << before << " in\n" << text;
  if (at == std::string::npos) return numbers;
  const char* rest = text.c_str() + at + before.size();
  for (double& each : numbers) {
    while (*rest == ' ' || *rest == ',') ++rest;
    char* end = nullptr;
    each = std::strtod(rest, &end);
    EXPECT_NE(end, rest) << before << " in\n" << text;
    rest = end;
  }
  return numbers;
}

Vec3d vector(const std::array<double, 3>& v) {
  return {v[0], v[1], v[2]};
}

const Vec3d kDirections[] = {{0, 0, 1}, {0, 0, -1}, {0, 1, 0}, {0, -1, 0}, {1, 0, 0}, {0.36, 0.48, -0.8}};

/// glTF, Blender and USD turn a light that shines along −Z: what is left of −Z afterwards points away from
/// it.
TEST(LightText, RotationsTurnTheLightToward) {
  for (const Vec3d& d : kDirections) {
    const auto q = numbers_after<4>(text_of("gltf", light_along(d, 1)), "\"rotation\": [");
    const Vec3d shines = rotation_from_quaternion(q[3], q[0], q[1], q[2]) * Vec3d{0, 0, -1};
    EXPECT_LT(length(shines + d), 1e-12);
    const auto orient = numbers_after<4>(text_of("usd", light_along(d, 1)), "xformOp:orient = (");
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(orient[i], q[(i + 3) % 4]);
  }
}

TEST(LightText, DirectionsAreInTheProgramsWorld) {
  for (const Vec3d& d : kDirections) {
    const LightSet set = light_along(d, 1);
    EXPECT_EQ(length(vector(numbers_after<3>(text_of("three.js", set), "position.set(")) - d), 0);
    EXPECT_EQ(length(vector(numbers_after<3>(text_of("bevy", set), "looking_to(Vec3::new(")) + d), 0);
    const Vec3d z_up{d.x, -d.z, d.y};
    EXPECT_EQ(length(vector(numbers_after<3>(text_of("blender", set), "add_sun('Light1', (")) - z_up), 0);
    const Vec3d left_handed{d.x, d.z, d.y};
    EXPECT_EQ(length(vector(numbers_after<3>(text_of("pbrt", set), "\"point3 from\" [")) - left_handed), 0);
    const std::string mitsuba = text_of("mitsuba", set);
    EXPECT_EQ(numbers_after<1>(mitsuba, "x=\"")[0], -d.x + 0);
    EXPECT_EQ(numbers_after<1>(mitsuba, "y=\"")[0], -d.y + 0);
    EXPECT_EQ(numbers_after<1>(mitsuba, "z=\"")[0], -d.z + 0);
  }
}

/// Colour times strength is the irradiance times the unit, in all of them.
TEST(LightText, IrradianceIsKept) {
  const LightSet set = light_along({0, 1, 0}, 0.5);
  const double unit = 100;
  const auto expect = [&](std::array<double, 3> colour, double strength) {
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(colour[c] * strength / (unit * set.lights[0].irradiance[c]), 1, 1e-5);
    for (const double each : colour) EXPECT_LE(each, 1);
  };
  const std::string three = text_of("three.js", set, unit), gltf = text_of("gltf", set, unit),
                    bevy = text_of("bevy", set, unit), blender = text_of("blender", set, unit),
                    usd = text_of("usd", set, unit);
  expect(numbers_after<3>(three, "setRGB("), numbers_after<1>(three, "intensity = ")[0]);
  expect(numbers_after<3>(gltf, "\"color\": ["), numbers_after<1>(gltf, "\"intensity\": ")[0]);
  expect(numbers_after<3>(bevy, "linear_rgb("), numbers_after<1>(bevy, "illuminance: ")[0]);
  expect(numbers_after<3>(blender, "'Light1', (0, 0, 1), ("),
         numbers_after<1>(blender, "(0.5, 1, 0.25), ")[0]);
  expect(numbers_after<3>(usd, "inputs:color = ("), numbers_after<1>(usd, "inputs:intensity = ")[0]);
  EXPECT_EQ(vector(numbers_after<3>(text_of("pbrt", set, unit), "\"rgb L\" [")).y, 400);
  EXPECT_EQ(vector(numbers_after<3>(text_of("mitsuba", set, unit), "irradiance\" value=\"")).z, 100);
}

/// A disc keeps its radiance: what the program computes of strength and angle, L = E / (π sin²ρ), is ∫ L dω /
/// Ω.
TEST(LightText, DiscsKeepTheirRadiance) {
  for (const double degrees : {0.53, 10.0, 60.0}) {
    const LightSet set = light_along({0, 1, 0}, degrees);
    const std::string usd = text_of("usd", set), blender = text_of("blender", set);
    EXPECT_NEAR(numbers_after<1>(usd, "inputs:angle = ")[0], degrees, 1e-5);
    const double sine = std::sin(degrees / 2 * kDegree);
    const double radiance = numbers_after<1>(usd, "inputs:intensity = ")[0] / (kPi * sine * sine);
    EXPECT_NEAR(radiance / (4 / set.lights[0].solid_angle), 1, 1e-5);
    EXPECT_NEAR(numbers_after<2>(blender, "(0.5, 1, 0.25), ")[1], degrees * kDegree, 1e-6);
  }
}

TEST(LightText, RegionsComeFromOneDirection) {
  LightSet set = light_along({0, 1, 0}, 60);
  set.lights[0].shape = LightShape::region;
  EXPECT_EQ(numbers_after<1>(text_of("usd", set), "inputs:angle = ")[0], 0);
  EXPECT_EQ(numbers_after<1>(text_of("usd", set), "inputs:intensity = ")[0], 4);
}

TEST(LightText, NoLightsAndBadRequests) {
  const LightSet none{{"R", "G", "B"}, {}};
  for (const LightFormat& each : light_formats()) {
    EXPECT_FALSE(light_text(each, none).empty()) << each.name;
    EXPECT_FALSE(each.extension.empty());
    EXPECT_FALSE(each.description.empty());
    EXPECT_THROW(light_text(each, none, 0), Error);
  }
  EXPECT_THROW(light_format_from_name("blendr"), Error);
  LightSet negative = light_along({0, 1, 0}, 1);
  negative.lights[0].irradiance = {-1, -2, -3};
  EXPECT_EQ(text_of("gltf", negative).find("-1"), std::string::npos);
}

}  // namespace
}  // namespace welkin
