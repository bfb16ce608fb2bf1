#pragma once

#include "welkin/sphere/octahedron.h"

namespace welkin::sphere {

/// The octahedron cut at the equator into two squares, side by side a 2:1 rectangle (Engelhardt & Dachsbacher
/// 2008, eq. 3): (p'x − p'z − 1, p'x + p'z) where y ≥ 0, (p'z − p'x + 1, p'x + p'z) where y < 0, in [−2, 2] ×
/// [−1, 1]. Chart 0 is the upper half (the left square), chart 1 the lower; the first coordinate runs right,
/// the second down. Corners of chart 0: −X top left, −Z top right, +Z bottom left, +X bottom right; of chart
/// 1 the same with left and right exchanged. A look-up rule, so seen from inside both are mirrored, as the
/// cube's faces are. Past an edge a square continues, exactly, over the other half of the world.
struct OctahedralRect : WholeWorld {
  static constexpr const char* kName = "octahedral-rect";
  static constexpr int kCharts = 2;
  static constexpr Traits kTraits{.projection = Projection::lookup};
  double aspect() const { return 1; }

  template <class T>
  Vec3<T> to_sphere(int chart, T u, T v) const {
    return normalize(point(chart, u, v));
  }

  template <class T>
  ChartPoint<T> from_sphere(const Vec3<T>& d) const {
    const T zero = constant<T>(0), one = constant<T>(1), half = constant<T>(0.5);
    const Vec3<T> p = octahedron_point(d);
    const auto below = p.y < zero;
    const T a = select(below, p.z - p.x, p.x - p.z);
    return {select(below, one, zero), half + half * a, half + half * (p.x + p.z)};
  }

  /// dx dz = ½ da db = 2 du dv.
  template <class T>
  T solid_angle_density(int chart, T u, T v) const {
    return constant<T>(2) * octahedron_density(point(chart, u, v));
  }

 private:
  /// The point of the octahedron, not normalised.
  template <class T>
  static Vec3<T> point(int chart, T u, T v) {
    const T one = constant<T>(1), two = constant<T>(2), half = constant<T>(0.5);
    const T side = constant<T>(chart == 0 ? 1 : -1);
    T a = two * u - one, b = two * v - one;
    const T height = fold_half(a, b);
    return {half * (b + side * a), side * height, half * (b - side * a)};
  }
};

}  // namespace welkin::sphere
