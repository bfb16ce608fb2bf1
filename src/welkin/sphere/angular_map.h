#pragma once

#include "welkin/sphere/disc.h"

namespace welkin::sphere {

/// The whole sphere in a disc whose radius is proportional to the angle from the centre (azimuthal
/// equidistant). Centre +Z, right −X, up +Y, seen from inside; the whole rim is −Z, the singular point. Past
/// the rim the radius still measures the angle. Debevec's light probes have −Z at the centre: their frame is
/// this one rotated by 180° about Y.
struct AngularMap : WholeWorld {
  static constexpr const char* kName = "angular";
  static constexpr int kCharts = 1;
  static constexpr Traits kTraits{.projection = Projection::disc};
  double aspect() const { return 1; }

  template <class T>
  Vec3<T> to_sphere(int, T u, T v) const {
    const DiscPoint<T> p = disc_point(u, v);
    const T scale = sine_ratio(constant<T>(kPi), p.radius);
    return {-p.right * scale, p.up * scale, cos(constant<T>(kPi) * p.radius)};
  }

  template <class T>
  ChartPoint<T> from_sphere(const Vec3<T>& d) const {
    const Polar<T> polar = polar_of(d);
    return disc_chart_point(-polar.x, polar.y, polar.angle() * constant<T>(1 / kPi));
  }

  /// dω = sin θ dθ dφ with θ = π r, and r dr dφ = 4 du dv.
  template <class T>
  T solid_angle_density(int, T u, T v) const {
    return constant<T>(4 * kPi) * sine_ratio(constant<T>(kPi), disc_point(u, v).radius);
  }

  template <class T>
  Mask<T> valid(int, T u, T v) const {
    return disc_point(u, v).radius <= constant<T>(1);
  }
};

}  // namespace welkin::sphere
