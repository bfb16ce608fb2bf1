#include "welkin/render/trace/surface.h"

#include <cmath>

namespace welkin::scene {

Grain grain_of(const Surface& surface) {
  // A normal map turns the normal away from the tangents.
  const Vec3d& n = surface.normal;
  const Vec3d t = normalize(surface.tangent - dot(surface.tangent, n) * n);
  const Vec3d b = (dot(cross(n, t), surface.bitangent) < 0 ? -1.0 : 1.0) * cross(n, t);
  const double angle = surface.material.anisotropy_angle, c = std::cos(angle), s = std::sin(angle);
  return {c * t + s * b, c * b - s * t};
}

RayDifferential reflected(const Surface& surface) {
  const Vec3d &n = surface.normal, &v = surface.view;
  const double cosine = dot(n, v);
  const auto change = [&](const Vec3d& dn, const Vec3d& dv) {
    return (2 * (dot(dn, v) + dot(n, dv))) * n + (2 * cosine) * dn - dv;
  };
  return {(2 * cosine) * n - v, change(surface.normal_change.right, surface.view_change.right),
          change(surface.normal_change.down, surface.view_change.down)};
}

RayDifferential refracted(const Surface& surface, double eta) {
  const Vec3d &n = surface.normal, &v = surface.view;
  const double ratio = 1 / eta, cosine = dot(n, v), square = 1 - ratio * ratio * (1 - cosine * cosine);
  if (!(square > 0)) return reflected(surface);
  // t = −ratio v + μ n, μ = ratio n·v − √square (Igehy 1999, eq. 17).
  const double behind = std::sqrt(square), mu = ratio * cosine - behind;
  const auto change = [&](const Vec3d& dn, const Vec3d& dv) {
    const double d_cosine = dot(dn, v) + dot(n, dv);
    const double d_mu = (ratio - ratio * ratio * cosine / behind) * d_cosine;
    return d_mu * n + mu * dn - ratio * dv;
  };
  return {mu * n - ratio * v, change(surface.normal_change.right, surface.view_change.right),
          change(surface.normal_change.down, surface.view_change.down)};
}

}  // namespace welkin::scene
