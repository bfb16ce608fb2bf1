#pragma once

#include "welkin/math/vec.h"

namespace welkin::sphere {

/// atan2(y, x) in [−π, π], and 0 for (0, 0). For packs and magnitudes from 1e-37 to 1e37 the error is at most
/// 4e-7: one division where atan2 of a pack has three.
///
/// atan(t)/t on [0, 1] is interpolated by a polynomial in t² at the nine Chebyshev nodes of [0, 1] (error
/// 1e-8); the octants follow from symmetry.
template <class T>
T polar_angle(T y, T x) {
  if constexpr (std::floating_point<T>) {
    return atan2(y, x);
  } else {
    const T ax = abs(x), ay = abs(y), zero = constant<T>(0);
    const T t = min(ax, ay) / max(max(ax, ay), constant<T>(1e-37));
    const T z = t * t, w = z * z;
    // Even and odd powers of z beside each other: two short chains of operations instead of a long one.
    const auto c = [](double value) { return constant<T>(value); };
    const T even =
        c(1.0) + w * (c(0.19991872) + w * (c(0.106183706) + w * (c(0.0421376236) + w * c(0.0027662835))));
    const T odd = c(-0.333330367) + w * (c(-0.141977978) + w * (c(-0.0745685483) + w * c(-0.0157312491)));
    const T first = t * (even + z * odd);
    const auto steep = ay > ax, back = x < zero, falling = steep ^ back;
    const T base = select(steep, c(kPi / 2), select(back, c(kPi), zero));
    return copysign(base + select(falling, -first, first), y);
  }
}

/// atan2(x, z): the angle around +Y from +Z toward +X, in [−π, π], and 0 on the axis.
template <class T>
T longitude_of(const Vec3<T>& d) {
  return polar_angle(d.x, d.z);
}

/// A direction of any length > 0 as a height on the +Y axis.
template <class T>
struct Height {
  T length;    ///< of the direction
  T distance;  ///< from the axis, over the length: cos(latitude)
  T height;    ///< sin(latitude)
  T depth;     ///< 1 − |height|: below the nearer pole, precise there
};

template <class T>
Height<T> height_of(const Vec3<T>& d) {
  const T across = d.x * d.x + d.z * d.z;
  const T length = sqrt(across + d.y * d.y);
  return {length, sqrt(across) / length, d.y / length, across / (length * (length + abs(d.y)))};
}

/// A direction of any length > 0 in polar coordinates around +Z: angle θ from +Z, and (x, y) the unit vector
/// of its part in the xy plane, (1, 0) on the axis.
template <class T>
struct Polar {
  T x, y, sine, cosine;

  T angle() const { return polar_angle(sine, cosine); }

  /// sin(θ/2), to full relative precision.
  T half_sine() const {
    const T one = constant<T>(1), zero = constant<T>(0), half = constant<T>(0.5);
    return select(cosine > zero, sine / sqrt(constant<T>(2) * (one + max(cosine, zero))),
                  sqrt(half * (one - min(cosine, zero))));
  }

  /// tan(θ/2), at most 10⁴.
  T half_tangent() const {
    const T one = constant<T>(1), zero = constant<T>(0);
    const T back = (one - min(cosine, zero)) / max(sine, constant<T>(1e-12));
    return min(select(cosine > zero, sine / (one + max(cosine, zero)), back), constant<T>(1e4));
  }
};

template <class T>
Polar<T> polar_of(const Vec3<T>& d) {
  const T zero = constant<T>(0), one = constant<T>(1);
  const T across = sqrt(d.x * d.x + d.y * d.y);
  const T length = sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
  const auto off_axis = across > zero;
  const T scale = one / select(off_axis, across, one);
  return {select(off_axis, d.x * scale, one), select(off_axis, d.y * scale, zero), across / length,
          d.z / length};
}

}  // namespace welkin::sphere
