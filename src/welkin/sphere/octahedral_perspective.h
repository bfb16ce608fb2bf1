#pragma once

#include "welkin/sphere/octahedron.h"

namespace welkin::sphere {

/// One perspective picture for each side of the octahedron (Engelhardt & Dachsbacher 2008, §3.2), seen from
/// inside: chart = 1 where x < 0, + 2 where y < 0, + 4 where z < 0, looking along (±1, ±1, ±1). The side's
/// equilateral triangle just fits the chart of aspect 2/√3: ±Y is the apex, on top for y ≥ 0 and at the
/// bottom for y < 0, and ±X and ±Z are the ends of the base. Only the triangle is valid; the picture's plane
/// continues outside.
///
/// The planar projection p' = p/(|x| + |y| + |z|) is this perspective one followed by an affine map: in an
/// octant |x| + |y|
/// + |z| = √3 n·p, with n the side's unit normal, so p' = p/(√3 n·p) is the central projection of p on the
/// side's plane, and each unfolding of the octahedron maps that plane by an affine map. So on every side
/// Octahedral, OctahedralRect and this one have proportional densities.
struct OctahedralPerspective : WholeWorld {
  static constexpr const char* kName = "octahedral-perspective";
  static constexpr int kCharts = 8;
  static constexpr Traits kTraits{
      .projection = Projection::lookup, .filled_to_edges = true, .grid_columns = 4};
  double aspect() const { return 1.1547005383792517; }

  template <class T>
  Vec3<T> to_sphere(int chart, T u, T v) const {
    return normalize(point(chart, weights(chart, u, v)));
  }

  template <class T>
  ChartPoint<T> from_sphere(const Vec3<T>& d) const {
    const T zero = constant<T>(0), one = constant<T>(1), half = constant<T>(0.5);
    const Vec3<T> p = octahedron_point(d);
    const auto x_back = d.x < zero, y_back = d.y < zero, z_back = d.z < zero;
    const T chart = select(x_back, one, zero) + select(y_back, constant<T>(2), zero) +
                    select(z_back, constant<T>(4), zero);
    const T apex = abs(p.y), right = select(x_back ^ z_back, abs(p.x), abs(p.z));
    return {chart, right + half * apex, select(y_back, apex, one - apex)};
  }

  /// The triangle of area √3/2 fills half of the chart, so dA = √3 du dv; and dω = dA · 1/(√3 |p'|) / |p'|².
  template <class T>
  T solid_angle_density(int chart, T u, T v) const {
    return octahedron_density(point(chart, weights(chart, u, v)));
  }

  template <class T>
  Mask<T> valid(int chart, T u, T v) const {
    const T zero = constant<T>(0);
    const Weights<T> w = weights(chart, u, v);
    const auto below_apex = w.apex >= zero, right = w.right >= zero, left = w.left >= zero;
    return below_apex & right & left;
  }

 private:
  /// Barycentric coordinates in the triangle of apex and left and right end of the base; their sum is 1.
  template <class T>
  struct Weights {
    T apex, left, right;
  };

  template <class T>
  static Weights<T> weights(int chart, T u, T v) {
    const T one = constant<T>(1), half = constant<T>(0.5);
    const T from_apex = (chart & 2) != 0 ? one - v : v;
    const T apex = (chart & 2) != 0 ? v : one - v;
    const T right = u - half * apex;
    return {apex, from_apex - right, right};
  }

  /// The point of the side's plane. Looking along (±1, ·, ±1), Z is to the right of X where x and z have the
  /// same sign.
  template <class T>
  static Vec3<T> point(int chart, const Weights<T>& w) {
    const bool x_back = (chart & 1) != 0, y_back = (chart & 2) != 0, z_back = (chart & 4) != 0;
    const T x = x_back != z_back ? w.right : w.left, z = x_back != z_back ? w.left : w.right;
    return {x_back ? -x : x, y_back ? -w.apex : w.apex, z_back ? -z : z};
  }
};

}  // namespace welkin::sphere
