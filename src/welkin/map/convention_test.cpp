#include "welkin/map/convention.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "welkin/base/error.h"
#include "welkin/map/borders.h"
#include "welkin/map/map.h"
#include "welkin/map/resample.h"

namespace welkin {
namespace {

using sphere::AnyParameterization;

struct Place {
  double u, v;
};

/// A program as its own source describes it, independent of the matrices under test.
struct Program {
  std::string name;
  std::function<Vec3d(const Vec3d&)> from_native;  ///< native direction → its world
  std::function<Place(const Vec3d&)> latlong;  ///< its world's direction → place in its lat-long, v down
  std::function<Vec3d(const Vec3d&)> cube;     ///< its world's direction → what it gives to a cube look-up
  int lookup_determinant;
};

double wrap(double u) {
  return u - std::floor(u);
}
Vec3d same(const Vec3d& d) {
  return d;
}
Vec3d reversed_x(const Vec3d& d) {
  return {-d.x, d.y, d.z};
}
Vec3d reversed_z(const Vec3d& d) {
  return {d.x, d.y, -d.z};
}
Vec3d y_and_z_swapped(const Vec3d& d) {
  return {d.x, d.z, d.y};
}
Vec3d blender_from_native(const Vec3d& d) {
  return {d.x, -d.z, d.y};
}

/// ½ + atan2(right, ahead)/2π, acos(up)/π.
Place around(double right, double ahead, double up) {
  return {0.5 + std::atan2(right, ahead) / (2 * kPi), std::acos(up) / kPi};
}
Place openexr(const Vec3d& d) {
  return {0.5 - std::atan2(d.x, d.z) / (2 * kPi), std::acos(d.y) / kPi};
}
Place from_left_edge(const Vec3d& d) {
  return {wrap(std::atan2(d.x, -d.z) / (2 * kPi)), std::acos(d.y) / kPi};
}
/// cmgen makes a cube with s.x to the right of s.z, then mirrors it in x.
Place filament(const Vec3d& d) {
  return around(-d.x, d.z, d.y);
}
/// Textures are read with v up.
Place three(const Vec3d& d) {
  return {std::atan2(d.z, d.x) / (2 * kPi) + 0.5, 1 - (std::asin(d.y) / kPi + 0.5)};
}
Place blender(const Vec3d& d) {
  const double v_up = (std::acos(d.z) - kPi) / -kPi;
  return {(std::atan2(d.y, d.x) - kPi) / (-2 * kPi), 1 - v_up};
}
Place unity(const Vec3d& d) {
  const double v_up = 1 - std::acos(d.y) / kPi;
  return {0.5 - std::atan2(d.z, d.x) / (2 * kPi), 1 - v_up};
}
Place unreal(const Vec3d& d) {
  return around(d.x, -d.y, d.z);
}
Place pbrt(const Vec3d& d) {
  return {wrap(std::atan2(d.y, d.x) / (2 * kPi)), std::acos(d.z) / kPi};
}
Place debevec(const Vec3d& d) {
  return {(1 + std::atan2(d.x, -d.z) / kPi) / 2, std::acos(d.y) / kPi};
}
Place left_handed(const Vec3d& d) {
  return around(d.x, d.z, d.y);
}

/// Blender and pbrt have no cube maps, and their `lookup` is native: their world's direction, taken back.
const Program kPrograms[] = {
    {"native", same, openexr, same, 1},
    {"openexr", same, openexr, same, 1},
    {"usd", same, openexr, same, 1},
    {"mitsuba", same, from_left_edge, same, 1},
    {"godot", same, from_left_edge, same, 1},
    {"filament", same, filament, same, 1},
    {"three.js", same, three, reversed_x, -1},
    {"blender", blender_from_native, blender,
     [](const Vec3d& d) {
       return Vec3d{d.x, d.z, -d.y};
     },
     1},
    {"unity", reversed_x, unity, same, -1},
    {"unreal", y_and_z_swapped, unreal, same, -1},
    {"pbrt", y_and_z_swapped, pbrt, y_and_z_swapped, 1},
    {"debevec", same, debevec, same, 1},
    {"left-handed", reversed_z, left_handed, same, -1},
};

const AnyParameterization& latlong() {
  static const auto p = AnyParameterization::make("latlong");
  return p;
}
const AnyParameterization& cube() {
  static const auto p = AnyParameterization::make("cube");
  return p;
}

std::vector<Vec3d> directions(int count) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  std::vector<Vec3d> list;
  for (int i = 0; i < count; ++i)
    list.push_back(normalize(Vec3d{normal(random), normal(random), normal(random)}));
  return list;
}

/// Distinguishable orientations.
Matrix3 turned(int quarter_turns) {
  return rotation_from_yaw_pitch_roll(90.0 * quarter_turns, 0, 0);
}

/// Difference of two places, across the left and right edges too.
double distance(double u, double v, const Place& p) {
  return std::hypot(std::remainder(u - p.u, 1.0), v - p.v);
}

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
  const Axes table[] = {{"native", z, minus_x},     {"openexr", z, minus_x},    {"usd", z, minus_x},
                        {"mitsuba", z, minus_x},    {"godot", z, minus_x},      {"filament", z, minus_x},
                        {"three.js", x, z},         {"blender", x, z},          {"unity", minus_x, minus_z},
                        {"unreal", minus_z, x},     {"pbrt", minus_x, minus_z}, {"debevec", minus_z, x},
                        {"left-handed", minus_z, x}};
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

/// Turns a native world of colours into the preset's cube, and looks it up as the program does. A colour is
/// the direction itself; half a texel of the source and of the cube apart is at most 0.06.
TEST(Convention, CubesReturnTheRadianceOfTheDirectionThatIsLookedUp) {
  Map world(latlong(), 128, 64, 3);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 128; ++x) {
      const Vec3d d = latlong().to_sphere(0, (x + 0.5) / 128, (y + 0.5) / 64);
      float* texel = world.level.chart(0).at(x, y);
      texel[0] = static_cast<float>(d.x);
      texel[1] = static_cast<float>(d.y);
      texel[2] = static_cast<float>(d.z);
    }
  }
  fill_borders(world);
  constexpr int kSize = 32;
  ResampleOptions options;
  options.filter = Filter::bilinear;
  for (const Program& program : kPrograms) {
    SCOPED_TRACE(program.name);
    Map map(cube(), kSize, kSize, 3);
    map.orientation = orientation_for(convention_from_name(program.name), cube());
    resample(world, map, options);
    for (const Vec3d& d : directions(300)) {
      const auto place = cube().from_sphere(program.cube(program.from_native(d)));
      const auto texel_of = [](double u) { return std::min(static_cast<int>(u * kSize), kSize - 1); };
      const auto face = map.level.chart(static_cast<int>(place.chart));
      const float* texel = face.at(texel_of(place.u), texel_of(place.v));
      EXPECT_LT(length(Vec3d{texel[0], texel[1], texel[2]} - d), 0.06);
    }
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
    const Place expected{(std::copysign(u, w.x) + 1) / 2, (std::copysign(v, w.y) + 1) / 2};
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
/// are parallels around +Y from the back's longitude to the back's, the other shows +Z in its middle and −X
/// right of it.
TEST(Convention, EveryPanoramaAndDiscIsKnownAsOne) {
  const Convention probe{"", "", turned(1), turned(2), turned(3), ""};
  for (const std::string& name : sphere::parameterization_names()) {
    const auto p = AnyParameterization::make(name);
    if (p.charts() != 1 || name == "half-cube") continue;
    const auto longitude = [&p](double u) {
      const Vec3d d = p.to_sphere(0, u, 0.4);
      return std::atan2(d.x, d.z);
    };
    const bool panorama = std::fabs(longitude(0.25) - kPi / 2) < 0.02 &&
                          std::fabs(longitude(0.75) + kPi / 2) < 0.02 &&
                          std::fabs(longitude(0.375) - kPi / 4) < 0.02;
    const bool disc = !p.valid(0, 0.01, 0.01) && p.to_sphere(0, 0.5, 0.5).z > 0.999;
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
