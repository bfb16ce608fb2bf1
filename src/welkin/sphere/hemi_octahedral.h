#pragma once

#include "welkin/sphere/octahedron.h"

namespace welkin::sphere {

/// The upper half of the octahedron, turned by 45° to fill a square: with p' = p/(|x| + |y| + |z|),
/// u = (1 + p'z − p'x)/2, v = (1 + p'z + p'x)/2. Centre +Y; corners −Z top left, −X top right, +X bottom
/// left, +Z bottom right; seen from inside (looking up). Past an edge the square continues, exactly, over the
/// lower half of the world.
struct HemiOctahedral {
  static constexpr const char* kName = "hemi-octahedral";
  static constexpr int kCharts = 1;
  static constexpr Traits kTraits{.projection = Projection::lookup};
  double aspect() const { return 1; }

  template <class T>
  Vec3<T> to_sphere(int, T u, T v) const {
    return normalize(point(u, v));
  }

  /// A direction below the horizon lands past the edge that it is nearer to, where to_sphere continues the
  /// square.
  template <class T>
  ChartPoint<T> from_sphere(const Vec3<T>& d) const {
    const T zero = constant<T>(0), half = constant<T>(0.5), two = constant<T>(2);
    const Vec3<T> p = octahedron_point(d);
    const T a = p.z - p.x, b = p.z + p.x;
    const auto below = p.y < zero, over_a = abs(a) >= abs(b);
    const T beyond_a = select(below & over_a, copysign(two - abs(a), a), a);
    const T beyond_b = select(below & !over_a, copysign(two - abs(b), b), b);
    return {zero, half + half * beyond_a, half + half * beyond_b};
  }

  /// dx dz = ½ da db = 2 du dv.
  template <class T>
  T solid_angle_density(int, T u, T v) const {
    return constant<T>(2) * octahedron_density(point(u, v));
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

 private:
  /// The point of the octahedron, not normalised.
  template <class T>
  static Vec3<T> point(T u, T v) {
    const T one = constant<T>(1), two = constant<T>(2), half = constant<T>(0.5);
    T a = two * u - one, b = two * v - one;
    const T height = fold_half(a, b);
    return {half * (b - a), height, half * (a + b)};
  }
};

}  // namespace welkin::sphere
