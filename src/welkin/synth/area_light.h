#pragma once

#include "welkin/math/vec.h"

namespace welkin::synth {

/// A rectangle that shines from one side, diffusely and evenly: centre ± half_width·right ± half_height·up.
/// `right`, `up` and `front` (the side that shines) are unit vectors, perpendicular to each other.
struct AreaLight {
  Vec3d centre, right, up, front;
  double half_width, half_height;

  double area() const { return 4 * half_width * half_height; }
};

/// A rectangle at `distance` from the origin toward unit `direction` (not ±Y), upright, shining toward the
/// origin.
AreaLight light_facing_origin(const Vec3d& direction, double distance, double width, double height);

/// Irradiance at `point` of a surface with unit `normal`, for radiance 1: ∫ cos dω over what the surface sees
/// of the light, without occluders. Exact: Lambert's formula for a polygon (1760), clipped by the surface's
/// horizon.
double irradiance_from(const AreaLight& light, const Vec3d& point, const Vec3d& normal);

/// Where the ray from the origin along d meets the light's plane, in units of the half width and half height,
/// x right and y up for someone who faces it; false when the ray doesn't come upon the shining side.
bool hit(const AreaLight& light, const Vec3d& d, double& x, double& y);

}  // namespace welkin::synth
