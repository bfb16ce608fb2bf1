#pragma once

#include "welkin/sphere/octahedron.h"

namespace welkin::sphere {

/// The octahedron unfolded to a square (Engelhardt & Dachsbacher 2008, eqs. 1 and 2): p' = p/(|x| + |y| +
/// |z|), then (p'x, p'z) where y ≥ 0 and ((1 − |p'z|) sgn p'x, (1 − |p'x|) sgn p'z) where y < 0, then ·½ + ½.
/// Centre +Y, corners −Y, right +X, down +Z: a look-up rule, so seen from inside it is mirrored, as the
/// cube's faces are. Past an edge the square is folded back (exact: a border texel is another texel of the
/// map). Density varies by 3√3 between the middle of a side and its corners.
struct Octahedral : WholeWorld {
  static constexpr const char* kName = "octahedral";
  static constexpr int kCharts = 1;
  static constexpr Traits kTraits{.projection = Projection::lookup};
  double aspect() const { return 1; }

  template <class T>
  Vec3<T> to_sphere(int, T u, T v) const {
    return normalize(point(u, v));
  }

  template <class T>
  ChartPoint<T> from_sphere(const Vec3<T>& d) const {
    const T zero = constant<T>(0), one = constant<T>(1), half = constant<T>(0.5);
    const Vec3<T> p = octahedron_point(d);
    const auto below = p.y < zero;
    const T s = select(below, copysign(one - abs(p.z), p.x), p.x);
    const T t = select(below, copysign(one - abs(p.x), p.z), p.z);
    return {zero, half + half * s, half + half * t};
  }

  template <class T>
  T solid_angle_density(int, T u, T v) const {
    return constant<T>(4) * octahedron_density(point(u, v));
  }

 private:
  /// The point of the octahedron, not normalised.
  template <class T>
  static Vec3<T> point(T u, T v) {
    const T one = constant<T>(1), two = constant<T>(2);
    const auto [s, t] = fold_square(two * u - one, two * v - one);
    const T y = one - abs(s) - abs(t);
    const auto below = y < constant<T>(0);
    return {select(below, copysign(one - abs(t), s), s), y, select(below, copysign(one - abs(s), t), t)};
  }
};

}  // namespace welkin::sphere
