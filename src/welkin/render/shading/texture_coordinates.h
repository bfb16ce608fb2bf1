#pragma once

#include <array>
#include <cmath>

#include "welkin/math/vec.h"

/// @file
/// Texture coordinates that a surface makes itself, in the eye's frame: x right, y up, z towards the viewer.
/// `normal` and `view` (towards the viewer) are unit vectors.
namespace welkin::scene {

/// Where a picture is looked up: u right, v down, the sphere's disc in the square of 0…1.
using SphereMapPlace = std::array<double, 2>;

/// The sphere map of normals: a photograph of a ball from far away, by ((1 + n_x)/2, (1 − n_y)/2).
inline SphereMapPlace sphere_map_of_normal(const Vec3d& normal) {
  return {(1 + normal.x) / 2, (1 - normal.y) / 2};
}

/// The direction of a cube map's look-up by the normal: the normal.
inline Vec3d normal_map_coordinates(const Vec3d& normal) {
  return normal;
}

/// The same by reflection: r = 2(n·v)n − v.
inline Vec3d reflection_map_coordinates(const Vec3d& normal, const Vec3d& view) {
  return 2 * dot(normal, view) * normal - view;
}

/// The sphere map of reflected directions: the normal that reflects r to a viewer at infinity, h = (r + z)/|r
/// + z|, in the disc. Of r = −z, the rim's lowest point.
inline SphereMapPlace sphere_map_of_reflection(const Vec3d& normal, const Vec3d& view) {
  const Vec3d r = reflection_map_coordinates(normal, view);
  const double m = 2 * std::sqrt(max(0.0, r.x * r.x + r.y * r.y + (r.z + 1) * (r.z + 1)));
  if (!(m > 1e-12)) return {0.5, 1};
  return {0.5 + r.x / m, 0.5 - r.y / m};
}

}  // namespace welkin::scene
