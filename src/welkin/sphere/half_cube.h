#pragma once

#include "welkin/sphere/parameterization.h"

namespace welkin::sphere {

/// The upper half of a cube unfolded to one square, as a hemicube is: the middle half × half is the face +Y,
/// and the four flaps around it are the upper halves of the sides, their horizon on the square's edges. The
/// corners are not valid. Centre +Y, right −X, down +Z: seen from inside (looking up), as the top of a cross
/// whose centre is +Z. Past a flap's sides its plane continues for half a corner; past the square's edges the
/// sides continue below the horizon.
struct HalfCube {
  static constexpr const char* kName = "half-cube";
  static constexpr int kCharts = 1;
  double aspect() const { return 1; }

  template <class T>
  Vec3<T> to_sphere(int, T u, T v) const {
    return normalize(point(u, v));
  }

  template <class T>
  ChartPoint<T> from_sphere(const Vec3<T>& d) const {
    const T half = constant<T>(0.5), quarter = constant<T>(0.25), two = constant<T>(2);
    const T right = -d.x, around = max(abs(d.x), abs(d.z));
    const T longest = max(max(around, d.y), constant<T>(0.2) * abs(d.y));
    const T scale = constant<T>(1) / longest;
    const T fall = two - d.y * scale;
    const auto top = d.y >= around, sideways = abs(d.x) >= abs(d.z);
    const T s = select(top, right * scale, select(sideways, copysign(fall, right), right * scale));
    const T t = select(top, d.z * scale, select(sideways, d.z * scale, copysign(fall, d.z)));
    return {constant<T>(0), half + quarter * s, half + quarter * t};
  }

  /// dω = dA/|p|³ on a plane at distance 1, and dA = 16 du dv.
  template <class T>
  T solid_angle_density(int, T u, T v) const {
    const Vec3<T> p = point(u, v);
    const T r2 = dot(p, p);
    return constant<T>(16) / (r2 * sqrt(r2));
  }

  template <class T>
  Mask<T> valid(int, T u, T v) const {
    const T quarter = constant<T>(0.25), half = constant<T>(0.5);
    const auto middle_column = abs(u - half) <= quarter, middle_row = abs(v - half) <= quarter;
    return middle_column | middle_row;
  }
  template <class T>
  Mask<T> covers(const Vec3<T>& d) const {
    return d.y >= constant<T>(0);
  }
  double coverage() const { return 2 * kPi; }

 private:
  /// The point of the cube with half side 1, not normalised. In a corner of the square the two flaps' planes
  /// continue until they meet on its diagonal, each as far past the cube's edge as it can and be back there.
  template <class T>
  static Vec3<T> point(T u, T v) {
    const T zero = constant<T>(0), one = constant<T>(1), two = constant<T>(2), four = constant<T>(4);
    const T s = four * u - two, t = four * v - two;
    const T over_s = max(abs(s) - one, zero), over_t = max(abs(t) - one, zero);
    const T past = min(min(over_s, over_t), abs(over_s - over_t));
    const auto side_t = over_t > over_s;
    const T right = clamp(s, -one, one) * (one + select(side_t, past, zero));
    const T down = clamp(t, -one, one) * (one + select(side_t, zero, past));
    return {-right, one - max(over_s, over_t), down};
  }
};

}  // namespace welkin::sphere
