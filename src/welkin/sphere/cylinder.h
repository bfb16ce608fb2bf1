#pragma once

#include "welkin/sphere/parameterization.h"
#include "welkin/sphere/polar.h"

namespace welkin::sphere {

/// A panorama on a cylinder around +Y: u = ½ − atan2(x, z)/2π as LatLong, v linear in the tangent of the
/// latitude, which is ±tan(fov/2) at the top and bottom edges. Past them the cylinder continues. Call
/// update() after changing `fov` (vertical, degrees, < 180).
struct Cylinder {
  static constexpr const char* kName = "cylinder";
  static constexpr int kCharts = 1;
  static constexpr Traits kTraits{.projection = Projection::panorama, .density_by_row = true};
  double fov = 90;

  explicit Cylinder(double fov_degrees = 90) : fov(fov_degrees) { update(); }
  /// Square texels at the equator: 2π wide, 2 tan(fov/2) high.
  double aspect() const { return kPi / top; }

  void update() {
    top = std::tan(fov * (kPi / 360));
    top_sine = std::sin(fov * (kPi / 360));
  }

  template <class Visitor>
  void visit_parameters(Visitor&& visit) {
    visit("fov", fov, 1.0, 179.0, "vertical field of view, degrees");
    update();
  }
  template <class Visitor>
  void visit_parameters(Visitor&& visit) const {
    visit("fov", fov, 1.0, 179.0, "vertical field of view, degrees");
  }

  template <class T>
  Vec3<T> to_sphere(int, T u, T v) const {
    const T half = constant<T>(0.5), longitude = constant<T>(2 * kPi) * (half - u);
    const T y = constant<T>(2 * top) * (half - v);
    const T cosine = constant<T>(1) / sqrt(constant<T>(1) + y * y);
    return {sin(longitude) * cosine, y * cosine, cos(longitude) * cosine};
  }

  /// The tangent of the latitude is taken as at most 10⁴.
  template <class T>
  ChartPoint<T> from_sphere(const Vec3<T>& d) const {
    const T half = constant<T>(0.5);
    const T across = max(sqrt(d.x * d.x + d.z * d.z), constant<T>(1e-4) * abs(d.y));
    const T v = half - constant<T>(0.5 / top) * (d.y / across);
    return {constant<T>(0), half - constant<T>(0.5 / kPi) * longitude_of(d), v};
  }

  /// dω = cos³(latitude) dy dλ.
  template <class T>
  T solid_angle_density(int, T, T v) const {
    const T y = constant<T>(2 * top) * (constant<T>(0.5) - v);
    const T secant2 = constant<T>(1) + y * y;
    return constant<T>(4 * kPi * top) / (secant2 * sqrt(secant2));
  }

  template <class T>
  Mask<T> valid(int, T u, T) const {
    return u == u;
  }
  template <class T>
  Mask<T> covers(const Vec3<T>& d) const {
    return abs(d.y) <= constant<T>(top) * sqrt(d.x * d.x + d.z * d.z);
  }
  double coverage() const { return 4 * kPi * top_sine; }

 private:
  double top = 0, top_sine = 0;  ///< tangent and sine of the latitude at the top
};

}  // namespace welkin::sphere
