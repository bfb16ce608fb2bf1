#pragma once

#include "welkin/sphere/registry.h"

namespace welkin {

/// A picture that holds another parameterization's disc in a circle of its own: a fish-eye photograph that
/// isn't square. Every function is that of the disc, in double.
struct CirclePart {
  static constexpr const char* kName = "circle-part";
  static constexpr int kCharts = 1;
  sphere::AnyParameterization disc = sphere::AnyParameterization::make("fisheye-equidistant");
  double x = 0.5, y = 0.5;          ///< the circle's centre in the chart
  double across = 0.5, down = 0.5;  ///< its radius, chart widths and heights

  double aspect() const { return down / across; }
  template <class T>
  Vec3<T> to_sphere(int chart, T u, T v) const {
    const Vec3d d = disc.to_sphere(chart, in_square(u, x, across), in_square(v, y, down));
    return {static_cast<T>(d.x), static_cast<T>(d.y), static_cast<T>(d.z)};
  }
  template <class T>
  sphere::ChartPoint<T> from_sphere(const Vec3<T>& d) const {
    const auto p = disc.from_sphere(in_double(d));
    return {T{0}, static_cast<T>(x + across * (2 * p.u - 1)), static_cast<T>(y + down * (2 * p.v - 1))};
  }
  template <class T>
  T solid_angle_density(int chart, T u, T v) const {
    return static_cast<T>(disc.solid_angle_density(chart, in_square(u, x, across), in_square(v, y, down)) /
                          (4 * across * down));
  }
  template <class T>
  bool valid(int chart, T u, T v) const {
    return disc.valid(chart, in_square(u, x, across), in_square(v, y, down));
  }
  template <class T>
  bool covers(const Vec3<T>& d) const {
    return disc.covers(in_double(d));
  }
  double coverage() const { return disc.coverage(); }

 private:
  template <class T>
  static double in_square(T position, double centre, double radius) {
    return 0.5 + 0.5 * (static_cast<double>(position) - centre) / radius;
  }
  template <class T>
  static Vec3d in_double(const Vec3<T>& d) {
    return {static_cast<double>(d.x), static_cast<double>(d.y), static_cast<double>(d.z)};
  }
};

}  // namespace welkin
