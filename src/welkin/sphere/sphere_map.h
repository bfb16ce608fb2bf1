#pragma once

#include "welkin/sphere/disc.h"

namespace welkin::sphere {

/// The picture of a mirror ball seen from far away on +Z: u = (1 + n.x)/2, v = (1 − n.y)/2 with n the ball's
/// normal, and d the reflection of the viewing vector (0, 0, 1) about n. Centre +Z, right +X, up +Y:
/// mirrored, as photographs of balls are. The whole rim is −Z, the singular point. Past it the picture goes
/// on as (2 − r, φ + 180°).
///
/// The look-up by half vector, h = (vo + r)/|vo + r| with vo = (0, 0, 1) (Heidrich & Seidel 1999, §2.1), is
/// this same map: the half vector of the viewing and the reflected ray is the normal. In polar coordinates
/// around +Z, r = sin(θ/2), so every texel measures the same solid angle (Lambert's azimuthal equal-area
/// projection, mirrored).
struct SphereMap : WholeWorld {
  static constexpr const char* kName = "sphere";
  static constexpr int kCharts = 1;
  static constexpr Traits kTraits{.density_by_row = true};
  double aspect() const { return 1; }

  /// θ = 2α with sin α = r.
  template <class T>
  Vec3<T> to_sphere(int, T u, T v) const {
    const T one = constant<T>(1), two = constant<T>(2);
    const DiscPoint<T> p = disc_point(u, v);
    const Arc<T> arc = arc_of_sine(p.radius);
    const T scale = two * arc.cosine * arc.ratio;
    return {p.right * scale, p.up * scale, one - two * arc.sine * arc.sine};
  }

  template <class T>
  ChartPoint<T> from_sphere(const Vec3<T>& d) const {
    const Polar<T> polar = polar_of(d);
    return disc_chart_point(polar.x, polar.y, polar.half_sine());
  }

  template <class T>
  T solid_angle_density(int, T, T) const {
    return constant<T>(16);
  }

  template <class T>
  Mask<T> valid(int, T u, T v) const {
    return disc_point(u, v).radius <= constant<T>(1);
  }
};

}  // namespace welkin::sphere
