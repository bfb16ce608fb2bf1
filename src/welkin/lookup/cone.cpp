#include "welkin/lookup/cone.h"

#include <cmath>

namespace welkin {
namespace {

bool points_somewhere(const Vec3<float>& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && (v.x != 0 || v.y != 0 || v.z != 0);
}

bool is_across(const Vec3<float>& axis, const Vec3<float>& direction) {
  const Vec3d a = normalize(Vec3d{axis.x, axis.y, axis.z});
  const Vec3d d = normalize(Vec3d{direction.x, direction.y, direction.z});
  constexpr double kSmallestSine = 1e-4;
  return length(cross(a, d)) > kSmallestSine;
}

}  // namespace

std::string fault_of(const EllipticalCone& cone) {
  if (!points_somewhere(cone.direction)) return "a cone's direction is zero or not finite";
  if (!(cone.narrow >= 0) || !std::isfinite(cone.narrow)) return "a cone's width is not a number of radians";
  if (!(cone.wide >= cone.narrow) || !std::isfinite(cone.wide))
    return "a cone's wide side is not at least as wide as its narrow one";
  if (cone.wide > cone.narrow && (!points_somewhere(cone.axis) || !is_across(cone.axis, cone.direction)))
    return "a cone's axis does not point across its direction";
  return "";
}

std::string fault_of(const QuadCone& cone) {
  Vec3d sum{0, 0, 0};
  for (const Vec3d& corner : cone.corners) {
    const double far = length(corner);
    if (!(far > 0) || !std::isfinite(far)) return "a cone's corner is zero or not finite";
    sum = sum + normalize(corner);
  }
  for (const Vec3d& corner : cone.corners) {
    if (!(dot(sum, normalize(corner)) > 1e-9)) return "a cone's corners don't lie within a hemisphere";
  }
  return "";
}

}  // namespace welkin
