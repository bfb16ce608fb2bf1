#pragma once

#include "welkin/sphere/latlong.h"

namespace welkin::sphere {

/// The upper half of LatLong: u as there, v = 0 at the zenith and 1 at the horizon. Past its edges LatLong
/// continues.
struct SkyLatLong {
  static constexpr const char* kName = "sky-latlong";
  static constexpr int kCharts = 1;
  static constexpr Traits kTraits{.projection = Projection::panorama, .density_by_row = true};
  double aspect() const { return 4; }

  template <class T>
  Vec3<T> to_sphere(int chart, T u, T v) const {
    return LatLong{}.to_sphere(chart, u, constant<T>(0.5) * v);
  }

  template <class T>
  ChartPoint<T> from_sphere(const Vec3<T>& d) const {
    const ChartPoint<T> p = LatLong{}.from_sphere(d);
    return {p.chart, p.u, p.v + p.v};
  }

  template <class T>
  T solid_angle_density(int chart, T u, T v) const {
    const T half = constant<T>(0.5);
    return half * LatLong{}.solid_angle_density(chart, u, half * v);
  }

  template <class T>
  Mask<T> valid(int, T u, T) const {
    return u == u;
  }
  template <class T>
  Mask<T> covers(const Vec3<T>& d) const {
    return d.y >= constant<T>(0);
  }
  double coverage() const { return 2 * kPi; }
};

}  // namespace welkin::sphere
