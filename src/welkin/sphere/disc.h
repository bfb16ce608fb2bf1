#pragma once

#include "welkin/sphere/parameterization.h"
#include "welkin/sphere/polar.h"

namespace welkin::sphere {

/// A position relative to the disc inscribed in a chart: right and up are ±1 at the chart's edges, radius 1
/// at the rim.
template <class T>
struct DiscPoint {
  T right, up, radius;
};

template <class T>
DiscPoint<T> disc_point(T u, T v) {
  const T one = constant<T>(1), two = constant<T>(2);
  const T right = two * u - one, up = one - two * v;
  return {right, up, sqrt(right * right + up * up)};
}

/// The chart point at `radius` along the unit vector (right, up); the inverse of disc_point.
template <class T>
ChartPoint<T> disc_chart_point(T right, T up, T radius) {
  const T half = constant<T>(0.5);
  return {constant<T>(0), half + half * right * radius, half - half * up * radius};
}

/// What a radially symmetric picture knows of a radius r: the angle θ from the axis that is seen there.
template <class T>
struct Ray {
  T sine_over_radius;  ///< sin θ / r, finite at the centre
  T cosine;            ///< cos θ
};

/// An angle a whose sine is x for x ∈ [0, 1], and that continues around the circle past it: sin a is the
/// triangle wave x, 2 − x, x − 4 … and cos a = ±√(1 − sin² a), so both are continuous. `ratio` is sin a / x,
/// finite at x = 0.
template <class T>
struct Arc {
  T sine, cosine, ratio;
};

template <class T>
Arc<T> arc_of_sine(T x) {
  const T one = constant<T>(1), two = constant<T>(2), half = constant<T>(0.5);
  const T turns = floor(half * (x + one));
  const T odd = turns - two * floor(half * turns);
  const T side = one - two * odd;
  const T near = x - two * turns;
  const T sine = side * near;
  return {sine, side * sqrt(max((one - near) * (one + near), constant<T>(0))),
          select(x < one, one, sine / max(x, one))};
}

/// sin(w r)/r for r ≥ 0, w at the centre.
template <class T>
T sine_ratio(T rate, T radius) {
  const auto off_centre = radius > constant<T>(0);
  return select(off_centre, sin(rate * radius) / select(off_centre, radius, constant<T>(1)), rate);
}

}  // namespace welkin::sphere
