#pragma once

#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "welkin/sphere/convention.h"

/// The programs that the conventions are named for, each as its own source describes it.
namespace welkin::cases {

using sphere::AnyParameterization;

struct Position {
  double u, v;
};

/// A program as its own source describes it, independent of the matrices under test.
struct Program {
  std::string name;
  std::function<Vec3d(const Vec3d&)> from_native;  ///< native direction → its world
  std::function<Position(const Vec3d&)>
      latlong;                              ///< its world's direction → position in its lat-long, v down
  std::function<Vec3d(const Vec3d&)> cube;  ///< its world's direction → what it gives to a cube look-up
  int lookup_determinant;
};

inline double wrap(double u) {
  return u - std::floor(u);
}
inline Vec3d same(const Vec3d& d) {
  return d;
}
inline Vec3d reversed_x(const Vec3d& d) {
  return {-d.x, d.y, d.z};
}
inline Vec3d reversed_z(const Vec3d& d) {
  return {d.x, d.y, -d.z};
}
inline Vec3d y_and_z_swapped(const Vec3d& d) {
  return {d.x, d.z, d.y};
}
inline Vec3d blender_from_native(const Vec3d& d) {
  return {d.x, -d.z, d.y};
}

/// ½ + atan2(right, ahead)/2π, acos(up)/π.
inline Position around(double right, double ahead, double up) {
  return {0.5 + std::atan2(right, ahead) / (2 * kPi), std::acos(up) / kPi};
}
inline Position openexr(const Vec3d& d) {
  return {0.5 - std::atan2(d.x, d.z) / (2 * kPi), std::acos(d.y) / kPi};
}
inline Position from_left_edge(const Vec3d& d) {
  return {wrap(std::atan2(d.x, -d.z) / (2 * kPi)), std::acos(d.y) / kPi};
}
/// cmgen makes a cube with s.x to the right of s.z, then mirrors it in x.
inline Position filament(const Vec3d& d) {
  return around(-d.x, d.z, d.y);
}
/// Textures are read with v up.
inline Position three(const Vec3d& d) {
  return {std::atan2(d.z, d.x) / (2 * kPi) + 0.5, 1 - (std::asin(d.y) / kPi + 0.5)};
}
inline Position blender(const Vec3d& d) {
  const double v_up = (std::acos(d.z) - kPi) / -kPi;
  return {(std::atan2(d.y, d.x) - kPi) / (-2 * kPi), 1 - v_up};
}
inline Position unity(const Vec3d& d) {
  const double v_up = 1 - std::acos(d.y) / kPi;
  return {0.5 - std::atan2(d.z, d.x) / (2 * kPi), 1 - v_up};
}
inline Position unreal(const Vec3d& d) {
  return around(d.x, -d.y, d.z);
}
inline Position pbrt(const Vec3d& d) {
  return {wrap(std::atan2(d.y, d.x) / (2 * kPi)), std::acos(d.z) / kPi};
}
inline Position debevec(const Vec3d& d) {
  return {(1 + std::atan2(d.x, -d.z) / kPi) / 2, std::acos(d.y) / kPi};
}
inline Position left_handed(const Vec3d& d) {
  return around(d.x, d.z, d.y);
}

/// A lat-long becomes a cube texture: the texel at look-up coordinates c of its face shows what lies along
/// (c.z, c.y, c.x), by the corners of the faces, of which longitude is atan2(z, x).
inline Position babylon(const Vec3d& c) {
  const Vec3d along{c.z, c.y, c.x};
  return {std::atan2(along.z, along.x) / (2 * kPi) + 0.5, std::acos(along.y) / kPi};
}
/// toSphericalUv of a direction whose x was reversed.
inline Position playcanvas(const Vec3d& d) {
  return {std::atan2(-d.x, d.z) / (2 * kPi) + 0.5, 1 - (std::asin(d.y) / kPi + 0.5)};
}
/// A glTF model's axes: ahead from +Z to +X, then up from +Y to +Z.
inline Vec3d cesium_from_native(const Vec3d& d) {
  const Vec3d ahead{d.z, d.y, -d.x};
  return {ahead.x, -ahead.z, ahead.y};
}
/// The frame of a model, Z up, to the cube's, Y up.
inline Vec3d cesium_cube(const Vec3d& d) {
  return {d.x, d.z, -d.y};
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
    {"babylon", reversed_x, babylon, same, -1},
    {"babylon-right-handed", same, [](const Vec3d& d) { return babylon(reversed_z(d)); }, reversed_z, -1},
    {"playcanvas", same, playcanvas, reversed_x, -1},
    // Without lat-longs, which are native.
    {"cesium", cesium_from_native,
     [](const Vec3d& d) {
       return openexr({d.y, d.z, d.x});
     },
     cesium_cube, 1},
    {"bevy", same, openexr, reversed_z, -1},
};

inline const AnyParameterization& latlong() {
  static const auto p = AnyParameterization::make("latlong");
  return p;
}
inline const AnyParameterization& cube() {
  static const auto p = AnyParameterization::make("cube");
  return p;
}

inline std::vector<Vec3d> directions(int count) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  std::vector<Vec3d> list;
  for (int i = 0; i < count; ++i)
    list.push_back(normalize(Vec3d{normal(random), normal(random), normal(random)}));
  return list;
}

/// Distinguishable orientations.
inline Matrix3 turned(int quarter_turns) {
  return rotation_from_yaw_pitch_roll(90.0 * quarter_turns, 0, 0);
}

/// Difference of two positions, across the left and right edges too.
inline double distance(double u, double v, const Position& p) {
  return std::hypot(std::remainder(u - p.u, 1.0), v - p.v);
}

}  // namespace welkin::cases
