#pragma once

#include "welkin/sphere/latlong_window.h"
#include "welkin/sphere/parameterization.h"
#include "welkin/sphere/polar.h"

namespace welkin::sphere {

/// Longitude × latitude: u = ½ − atan2(x, z)/2π, v = acos(y)/π. +Z at the centre, +X a quarter to its left,
/// +Y on top (OpenEXR's axes). Past a pole the picture continues down the opposite meridian.
struct LatLong : WholeWorld {
  static constexpr const char* kName = "latlong";
  using WithParameters = LatLongWindow;
  static constexpr int kCharts = 1;
  static constexpr Traits kTraits{
      .projection = Projection::panorama, .density_by_row = true, .latlong_grid = true};
  double aspect() const { return 2; }

  template <class T>
  Vec3<T> to_sphere(int, T u, T v) const {
    const T longitude = constant<T>(2 * kPi) * (constant<T>(0.5) - u);
    const T colatitude = constant<T>(kPi) * v;
    const T sine = sin(colatitude);
    return {sine * sin(longitude), cos(colatitude), sine * cos(longitude)};
  }

  /// acos(y) is written as the polar angle of (√(x² + z²), y), which keeps its precision at the poles and
  /// takes any length.
  template <class T>
  ChartPoint<T> from_sphere(const Vec3<T>& d) const {
    const T around = longitude_of(d);
    const T down = polar_angle(sqrt(d.x * d.x + d.z * d.z), d.y);
    return {constant<T>(0), constant<T>(0.5) - constant<T>(0.5 / kPi) * around, constant<T>(1 / kPi) * down};
  }

  template <class T>
  T solid_angle_density(int, T, T v) const {
    return constant<T>(2 * kPi * kPi) * sin(constant<T>(kPi) * v);
  }
};

}  // namespace welkin::sphere
