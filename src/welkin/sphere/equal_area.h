#pragma once

#include "welkin/sphere/parameterization.h"
#include "welkin/sphere/polar.h"

namespace welkin::sphere {

/// Longitude × sine of latitude (Lambert's cylindrical equal-area projection): u = ½ − atan2(x, z)/2π, v = (1
/// − y)/2. Axes as LatLong. Every texel measures the same solid angle; aspect π makes the texels at the
/// equator square. Past a pole the picture continues down the opposite meridian.
struct EqualArea : WholeWorld {
  static constexpr const char* kName = "equal-area";
  static constexpr int kCharts = 1;
  static constexpr Traits kTraits{
      .projection = Projection::panorama, .density_by_row = true, .free_aspect = true};
  double aspect() const { return kPi; }

  /// cos(latitude) = √(1 − y²) = 2√(v (1 − v)), negative past a pole.
  template <class T>
  Vec3<T> to_sphere(int, T u, T v) const {
    const T zero = constant<T>(0), one = constant<T>(1), two = constant<T>(2);
    const T longitude = constant<T>(2 * kPi) * (constant<T>(0.5) - u);
    const T folded = select(v > one, two - v, abs(v));
    const T cosine = two * sqrt(max(folded * (one - folded), zero));
    const T signed_cosine = select((v < zero) | (v > one), -cosine, cosine);
    return {signed_cosine * sin(longitude), one - two * folded, signed_cosine * cos(longitude)};
  }

  template <class T>
  ChartPoint<T> from_sphere(const Vec3<T>& d) const {
    const T half = constant<T>(0.5);
    const Height<T> h = height_of(d);
    const T from_pole = half * h.depth;
    const T v = select(d.y < constant<T>(0), constant<T>(1) - from_pole, from_pole);
    return {constant<T>(0), half - constant<T>(0.5 / kPi) * longitude_of(d), v};
  }

  template <class T>
  T solid_angle_density(int, T, T) const {
    return constant<T>(4 * kPi);
  }
};

}  // namespace welkin::sphere
