#pragma once

#include "welkin/math/vec.h"

/// @file
/// Angles, and angles between directions.
namespace welkin {

/// One degree in radians.
inline constexpr double kDegree = kPi / 180;

/// The sun's mean angular diameter seen from Earth, degrees.
inline constexpr double kSunDiameter = 0.5331;

/// Unit direction at an azimuth and elevation in degrees: azimuth turns about +Y from +Z toward +X, elevation
/// rises from the horizon toward +Y.
inline Vec3d direction_at(double azimuth, double elevation) {
  const double level = cos(elevation * kDegree);
  return {level * sin(azimuth * kDegree), sin(elevation * kDegree), level * cos(azimuth * kDegree)};
}

/// Angle between two directions of any length > 0, radians, 0…π. By the arc tangent of sine over cosine,
/// which keeps its precision where the angle is small or near π.
inline double angle_between(const Vec3d& a, const Vec3d& b) {
  return atan2(length(cross(a, b)), dot(a, b));
}

/// 0 up to `from`, 1 beyond `to` > `from`, smooth between: 3t² − 2t³.
inline double smooth_step(double from, double to, double x) {
  const double t = clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

}  // namespace welkin
