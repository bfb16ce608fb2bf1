#include "welkin/sphere/convention.h"

#include <gtest/gtest.h>

#include <cmath>

#include "welkin/base/error.h"
#include "welkin/sphere/convention_cases.h"

namespace welkin {
namespace {

using namespace cases;

TEST(Convention, EveryPresetIsDescribedByAProgram) {
  ASSERT_EQ(conventions().size(), std::size(kPrograms));
  for (std::size_t i = 0; i < conventions().size(); ++i) {
    EXPECT_EQ(conventions()[i].name, kPrograms[i].name);
    EXPECT_FALSE(conventions()[i].description.empty());
    EXPECT_FALSE(conventions()[i].source.empty());
  }
}

TEST(Convention, MatricesAreOrthonormalAndPicturesAreNeverMirrored) {
  for (const Program& program : kPrograms) {
    SCOPED_TRACE(program.name);
    const Convention& c = convention_from_name(program.name);
    for (const Matrix3& m : {c.latlong, c.lookup, c.disc}) EXPECT_EQ(m * transpose(m), Matrix3{});
    EXPECT_EQ(determinant(c.latlong), 1);
    EXPECT_EQ(determinant(c.disc), 1);
    EXPECT_EQ(determinant(c.lookup), program.lookup_determinant);
  }
}

TEST(Convention, NativeIsIdentity) {
  const Convention& native = conventions().front();
  EXPECT_EQ(native.name, "native");
  for (const std::string& name : sphere::parameterization_names()) {
    EXPECT_EQ(orientation_for(native, AnyParameterization::make(name)), Matrix3{}) << name;
  }
}

TEST(Convention, WorldsAreThoseOfThePrograms) {
  for (const Program& program : kPrograms) {
    SCOPED_TRACE(program.name);
    const Matrix3& world = convention_from_name(program.name).world;
    EXPECT_EQ(world * transpose(world), Matrix3{});
    for (const Vec3d& d : directions(20)) EXPECT_EQ(length(world * d - program.from_native(d)), 0);
  }
}

/// A lat-long formula and its preset agree everywhere; 1e-12 is the rounding of acos and atan2 away from
/// poles.
TEST(Convention, LatLongsAgreeWithTheProgramsFormulas) {
  for (const Program& program : kPrograms) {
    SCOPED_TRACE(program.name);
    const Matrix3 orientation = orientation_for(convention_from_name(program.name), latlong());
    for (const Vec3d& d : directions(500)) {
      if (std::fabs(d.y) > 0.999) continue;
      const auto p = latlong().from_sphere(orientation * d);
      EXPECT_LT(distance(p.u, p.v, program.latlong(program.from_native(d))), 1e-12);
    }
    EXPECT_EQ(latlong().from_sphere(orientation * Vec3d{0, 1, 0}).v, 0);
    EXPECT_EQ(latlong().from_sphere(orientation * Vec3d{0, -1, 0}).v, 1);
  }
}

/// What docs/conventions.md says of each: which native axis is at the centre, and which a quarter to its
/// right.
TEST(Convention, TableOfAxesHolds) {
  struct Axes {
    const char* name;
    Vec3d centre, right;
  };
  const Vec3d x{1, 0, 0}, minus_x{-1, 0, 0}, z{0, 0, 1}, minus_z{0, 0, -1};
  const Axes table[] = {
      {"native", z, minus_x},      {"openexr", z, minus_x},    {"usd", z, minus_x},
      {"mitsuba", z, minus_x},     {"godot", z, minus_x},      {"filament", z, minus_x},
      {"three.js", x, z},          {"blender", x, z},          {"unity", minus_x, minus_z},
      {"unreal", minus_z, x},      {"pbrt", minus_x, minus_z}, {"debevec", minus_z, x},
      {"left-handed", minus_z, x}, {"babylon", z, minus_x},    {"babylon-right-handed", minus_z, x},
      {"playcanvas", z, minus_x},  {"cesium", z, minus_x},     {"bevy", z, minus_x}};
  ASSERT_EQ(std::size(table), conventions().size());
  for (const Axes& each : table) {
    SCOPED_TRACE(each.name);
    const Matrix3 orientation = orientation_for(convention_from_name(each.name), latlong());
    const auto centre = latlong().from_sphere(orientation * each.centre);
    const auto right = latlong().from_sphere(orientation * each.right);
    EXPECT_NEAR(centre.u, 0.5, 1e-15);
    EXPECT_NEAR(centre.v, 0.5, 1e-15);
    EXPECT_NEAR(right.u, 0.75, 1e-15);
    EXPECT_NEAR(right.v, 0.5, 1e-15);
  }
}

/// Clarberg's map as pbrt writes it: +Z in the middle, +X to the right, +Y down.
TEST(Convention, PbrtsEqualAreaOctahedronIsOurs) {
  const auto octahedron = AnyParameterization::make("octahedral-equal-area");
  const Matrix3 orientation = orientation_for(convention_from_name("pbrt"), octahedron);
  for (const Vec3d& d : directions(500)) {
    const Vec3d w = y_and_z_swapped(d);
    const double r = std::sqrt(1 - std::fabs(w.z)),
                 phi = std::atan2(std::fabs(w.y), std::fabs(w.x)) * 2 / kPi;
    double v = phi * r, u = r - v;
    if (w.z < 0) {
      const double across = u;
      u = 1 - v;
      v = 1 - across;
    }
    const Position expected{(std::copysign(u, w.x) + 1) / 2, (std::copysign(v, w.y) + 1) / 2};
    const auto p = octahedron.from_sphere(orientation * d);
    EXPECT_NEAR(p.u, expected.u, 1e-9);
    EXPECT_NEAR(p.v, expected.v, 1e-9);
  }
}

/// Cycles' mirror ball, whose formula is (x, z)/2√((1 − y)/2), is the native sphere map under Blender's axes.
TEST(Convention, BlendersMirrorBallIsTheNativeSphereMap) {
  const auto ball = AnyParameterization::make("sphere");
  const Matrix3 orientation = orientation_for(convention_from_name("blender"), ball);
  for (const Vec3d& d : directions(500)) {
    const Vec3d w = blender_from_native(d);
    const double scale = 2 * std::sqrt((1 - w.y) / 2);
    const auto p = ball.from_sphere(orientation * d);
    EXPECT_NEAR(p.u, (w.x / scale + 1) / 2, 1e-9);
    EXPECT_NEAR(1 - p.v, (w.z / scale + 1) / 2, 1e-9);
  }
}

/// Straight ahead, −Z, is at the centre; +X right, +Y up; the radius is the angle over π.
TEST(Convention, DebevecsAngularMapLooksAlongMinusZ) {
  const auto angular = AnyParameterization::make("angular");
  const Matrix3 orientation = orientation_for(convention_from_name("debevec"), angular);
  for (const Vec3d& d : directions(500)) {
    const double r = std::acos(-d.z) / kPi / std::hypot(d.x, d.y);
    const auto p = angular.from_sphere(orientation * d);
    EXPECT_NEAR(p.u, (d.x * r + 1) / 2, 1e-9);
    EXPECT_NEAR(p.v, (1 - d.y * r) / 2, 1e-9);
  }
}

/// Panoramas and discs are told by their geometry, so that a new one can't be forgotten: the rows of the one
/// are parallels around +Y at even steps of longitude, from the left of +Z to its right; the other, or the
/// rectangle that a camera sees, shows +Z in its middle and −X right of it.
TEST(Convention, EveryPanoramaAndDiscIsKnownAsOne) {
  const Convention probe{"", "", turned(1), turned(2), turned(3), {}, ""};
  for (const std::string& name : sphere::parameterization_names()) {
    const auto p = AnyParameterization::make(name);
    if (p.charts() != 1 || name == "half-cube") continue;
    const auto longitude = [&p](double u) {
      const Vec3d d = p.to_sphere(0, u, 0.4);
      return std::atan2(d.x, d.z);
    };
    const bool parallel = std::fabs(p.to_sphere(0, 0.25, 0.4).y - p.to_sphere(0, 0.5, 0.4).y) < 1e-6;
    const double quarter = longitude(0.25);
    const bool panorama = p.valid(0, 0.01, 0.01) && parallel && quarter > 0.4 &&
                          std::fabs(longitude(0.75) + quarter) < 0.02 &&
                          std::fabs(longitude(0.375) - quarter / 2) < 0.02;
    const bool disc = p.to_sphere(0, 0.5, 0.5).z > 0.999;
    const bool from_inside = p.to_sphere(0, 0.75, 0.5).x < 0;
    const Matrix3 expected = panorama              ? probe.latlong
                             : disc && from_inside ? probe.disc
                             : disc                ? Matrix3{}
                                                   : probe.lookup;
    EXPECT_EQ(orientation_for(probe, p), expected) << name;
  }
}

TEST(Convention, BallsAndHalfCubesAreNeverTurned) {
  for (const Convention& c : conventions()) {
    for (const char* name : {"sphere", "mirror-ball", "half-cube"}) {
      EXPECT_EQ(orientation_for(c, AnyParameterization::make(name)), Matrix3{}) << c.name << ' ' << name;
    }
  }
}

/// Mitsuba reads texel (x, y) of W×H, which has a copy of its first column at its end, at
/// u (W + 1 − 1) − ½ and v (H − 1), where u = atan2(x, −z)/2π and v = acos(y)/π.
TEST(Convention, MitsubasRowsEndAtThePoles) {
  const Convention& mitsuba = convention_from_name("mitsuba");
  constexpr int kWidth = 16, kHeight = 8;
  const auto p = parameterization_for(mitsuba, latlong()).at_size(kWidth, kHeight);
  EXPECT_EQ(p.name(), "mitsuba-latlong");
  const Matrix3 orientation = orientation_for(mitsuba, p);
  for (const Vec3d& d : directions(500)) {
    const Position at = from_left_edge(d);
    const auto ours = p.from_sphere(orientation * d);
    EXPECT_NEAR(std::remainder(ours.u * kWidth - 0.5 - (at.u * kWidth - 0.5), kWidth), 0, 1e-12);
    EXPECT_NEAR(ours.v * kHeight - 0.5, at.v * (kHeight - 1), 1e-12);
  }
  for (int y = 0; y < kHeight; ++y)
    EXPECT_NEAR(p.to_sphere(0, 0.5, (y + 0.5) / kHeight).y, std::cos(y * kPi / (kHeight - 1)), 1e-12);
  const auto window = AnyParameterization::make("latlong,top=0");
  EXPECT_EQ(parameterization_for(mitsuba, window), window);
  EXPECT_EQ(parameterization_for(mitsuba, cube()), cube());
  for (const Convention& each : conventions()) {
    const auto written = parameterization_for(each, latlong());
    EXPECT_EQ(written.name(), each.name == "mitsuba" ? "mitsuba-latlong" : "latlong") << each.name;
  }
}

TEST(Convention, UnknownNamesSuggestTheNearest) {
  try {
    convention_from_name("threejs");
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("unknown convention 'threejs'; did you mean 'three.js'?"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace welkin
