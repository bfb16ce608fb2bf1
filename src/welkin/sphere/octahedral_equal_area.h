#pragma once

#include "welkin/sphere/octahedron.h"
#include "welkin/sphere/polar.h"

namespace welkin::sphere {

/// The equal-area octahedron (Clarberg 2008): unfolded as Octahedral, with the same axes and the same fold
/// past its edges, but every texel measures the same solid angle. In a quarter of the upper half, with s and
/// t the distances from the axes, the distance r = s + t from the pole gives y = 1 − r², and t/r the
/// longitude, a quarter turn from 0 to 1.
struct OctahedralEqualArea : WholeWorld {
  static constexpr const char* kName = "octahedral-equal-area";
  static constexpr int kCharts = 1;
  static constexpr Traits kTraits{.projection = Projection::lookup, .density_by_row = true};
  double aspect() const { return 1; }

  template <class T>
  Vec3<T> to_sphere(int, T u, T v) const {
    const T zero = constant<T>(0), one = constant<T>(1), two = constant<T>(2);
    const auto [s, t] = fold_square(two * u - one, two * v - one);
    const T across = abs(s), along = abs(t);
    const auto below = across + along > one;
    const T p = select(below, one - along, across), q = select(below, one - across, along);
    const T r = p + q, r2 = r * r;
    const T angle = constant<T>(kPi / 2) * (q / select(r > zero, r, one));
    const T side = r * sqrt(two - r2);
    return {copysign(side * cos(angle), s), select(below, r2 - one, one - r2),
            copysign(side * sin(angle), t)};
  }

  template <class T>
  ChartPoint<T> from_sphere(const Vec3<T>& d) const {
    const T zero = constant<T>(0), one = constant<T>(1), half = constant<T>(0.5);
    const T r = sqrt(height_of(d).depth);
    const T quarter = constant<T>(2 / kPi) * longitude_of(Vec3<T>{abs(d.z), d.y, abs(d.x)});
    const T q = quarter * r, p = r - q;
    const auto below = d.y < zero;
    const T s = copysign(select(below, one - q, p), d.x), t = copysign(select(below, one - p, q), d.z);
    return {zero, half + half * s, half + half * t};
  }

  template <class T>
  T solid_angle_density(int, T, T) const {
    return constant<T>(4 * kPi);
  }
};

}  // namespace welkin::sphere
