#include "welkin/synth/area_light.h"

#include <array>
#include <cassert>

#include "welkin/math/angles.h"

namespace welkin::synth {

AreaLight light_facing_origin(const Vec3d& direction, double distance, double width, double height) {
  assert(abs(direction.y) < 1);
  const Vec3d right = normalize(cross(direction, {0, 1, 0}));
  return {distance * direction, right, cross(right, direction), -1.0 * direction, width / 2, height / 2};
}

double irradiance_from(const AreaLight& light, const Vec3d& point, const Vec3d& normal) {
  // The light shines on its front side only.
  const Vec3d to_centre = light.centre - point;
  if (dot(light.front, to_centre) > -1e-9) return 0;

  // Corners as seen from the point.
  std::array<Vec3d, 4> corners;
  constexpr double kSigns[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  for (std::size_t i = 0; i < 4; ++i) {
    corners[i] = to_centre + (kSigns[i][0] * light.half_width) * light.right +
                 (kSigns[i][1] * light.half_height) * light.up;
  }

  // Clip by the horizon: a plane cuts a rectangle into at most five corners.
  std::array<Vec3d, 8> seen;
  std::size_t count = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3d &a = corners[i], &b = corners[(i + 1) % 4];
    const double above_a = dot(a, normal), above_b = dot(b, normal);
    if (above_a >= 0) seen[count++] = a;
    if ((above_a >= 0) != (above_b >= 0)) seen[count++] = a + (above_a / (above_a - above_b)) * (b - a);
  }

  // E = ½ Σ angle of edge × cosine between the edge's plane and the surface.
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3d &a = seen[i], &b = seen[(i + 1) % count];
    const Vec3d turn = cross(a, b);
    const double sine = length(turn);
    if (sine > 0) sum += atan2(sine, dot(a, b)) * dot(turn, normal) / sine;
  }
  return abs(sum) / 2;
}

bool hit(const AreaLight& light, const Vec3d& d, double& x, double& y) {
  const double toward = dot(d, light.front);
  const double distance = dot(light.centre, light.front);
  if (toward >= 0 || distance >= 0) return false;
  const Vec3d offset = (distance / toward) * d - light.centre;
  x = dot(offset, light.right) / light.half_width;
  y = dot(offset, light.up) / light.half_height;
  return true;
}

}  // namespace welkin::synth
