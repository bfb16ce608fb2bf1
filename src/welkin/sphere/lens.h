#pragma once

#include "welkin/sphere/disc.h"

namespace welkin::sphere {

/// How a camera projects the sphere onto its image plane. Around +Z; x runs right (−X) and y up (+Y), and
/// near the axis a unit is a radian. θ is the angle from the axis, r the distance from the plane's origin, φ
/// the azimuth (to the right) and β the elevation.
enum class Lens {
  perspective,    ///< r = tan θ: straight lines stay straight
  stereographic,  ///< r = 2 tan(θ/2): circles stay circles
  equidistant,    ///< r = θ
  equisolid,      ///< r = 2 sin(θ/2): areas are solid angles
  orthographic,   ///< r = sin θ
  pannini,        ///< x = S sin φ, y = S tan β, S = (d + 1)/(d + cos φ): verticals stay straight
  cylindrical,    ///< x = φ, y = tan β
};

/// Whether r depends on θ alone.
constexpr bool is_radial(Lens lens) {
  return lens <= Lens::orthographic;
}

/// A point of the image plane.
template <class T>
struct PlanePoint {
  T x, y;
};

/// Of the radial lenses, the angle seen at distance r, r of an angle, and solid angle per area of the plane:
/// sin θ/r dθ/dr. Past the last angle they go on as the fish-eyes do (fisheye.h).
/// @{
template <class T>
Ray<T> radial_ray(Lens lens, T r) {
  const T one = constant<T>(1), half = constant<T>(0.5);
  switch (lens) {
    case Lens::stereographic: {
      const T t = half * r, part = one / (one + t * t);
      return {part, (one - t * t) * part};
    }
    case Lens::equidistant:
      return {sine_ratio(one, r), cos(r)};
    case Lens::equisolid: {
      const Arc<T> arc = arc_of_sine(half * r);
      return {arc.cosine * arc.ratio, one - constant<T>(2) * arc.sine * arc.sine};
    }
    case Lens::orthographic: {
      const Arc<T> arc = arc_of_sine(r);
      return {arc.ratio, arc.cosine};
    }
    default: {
      const T cosine = one / sqrt(one + r * r);
      return {cosine, cosine};
    }
  }
}

template <class T>
T radial_distance(Lens lens, const Polar<T>& polar) {
  const T two = constant<T>(2);
  switch (lens) {
    case Lens::stereographic:
      return two * polar.half_tangent();
    case Lens::equidistant:
      return polar.angle();
    case Lens::equisolid:
      return two * polar.half_sine();
    case Lens::orthographic:  // behind the camera past the rim, as radial_ray goes on
      return select(polar.cosine < constant<T>(0), two - polar.sine, polar.sine);
    default:
      return polar.sine / max(polar.cosine, constant<T>(1e-4));
  }
}

template <class T>
T radial_density(Lens lens, T r) {
  const T one = constant<T>(1);
  switch (lens) {
    case Lens::stereographic: {
      const T part = one / (one + constant<T>(0.25) * r * r);
      return part * part;
    }
    case Lens::equidistant:
      return abs(sine_ratio(one, r));
    case Lens::equisolid:
      return one;
    case Lens::orthographic:
      return one / max(abs(arc_of_sine(r).cosine), constant<T>(1e-4));
    default: {
      const T secant2 = one + r * r;
      return one / (secant2 * sqrt(secant2));
    }
  }
}
/// @}

/// What Lens::pannini takes.
struct PanniniShape {
  double distance = 1;  ///< d: of the second centre from the first, in radii; 0 is the perspective
  double vertical = 0;  ///< how much S in y gives way to 1/cos φ, with which horizontals are straight: 0 to 1
};

/// The azimuth of a column of Lens::pannini, and its scales.
template <class T>
struct PanniniColumn {
  T sine, cosine;  ///< of φ
  T across, up;    ///< x = across·sin φ, y = up·tan β

  /// From S, and a cosine kept from 0 where it is divided by.
  void set_scales(T s, const PanniniShape& shape) {
    across = s;
    up = constant<T>(1 - shape.vertical) * s;
    if (shape.vertical > 0) up = up + constant<T>(shape.vertical) / max(cosine, constant<T>(1e-2));
  }
};

/// Of x, by k = (x/(d + 1))²: cos φ = (√Δ − k d)/(k + 1), Δ = 1 + k (1 − d²); Sharpless, Postle & German
/// 2010. d + cos φ is (d + √Δ)/(k + 1), without cancellation.
template <class T>
PanniniColumn<T> pannini_column(const T& x, const PanniniShape& shape) {
  const double d = shape.distance;
  const T one = constant<T>(1), over = constant<T>(1 / (d + 1)) * x, k = over * over;
  const T root = sqrt(one + constant<T>(1 - d * d) * k), part = one / (k + one);
  const T s = constant<T>(d + 1) * (k + one) / (constant<T>(d) + root);
  PanniniColumn<T> column{x / s, (root - constant<T>(d) * k) * part, s, s};
  column.set_scales(s, shape);
  return column;
}

/// Of sin φ and cos φ. 1 + cos φ without cancellation.
template <class T>
PanniniColumn<T> pannini_column(const T& sine, const T& cosine, const PanniniShape& shape) {
  const T one = constant<T>(1), zero = constant<T>(0);
  const T behind = sine * sine / (one - min(cosine, zero));
  const T past = constant<T>(shape.distance - 1) + select(cosine < zero, behind, one + cosine);
  const T s = constant<T>(shape.distance + 1) / max(past, constant<T>(1e-4));
  PanniniColumn<T> column{sine, cosine, s, s};
  column.set_scales(s, shape);
  return column;
}

/// A direction from its azimuth and the tangent of its elevation.
template <class T>
Vec3<T> direction_of(const T& sine, const T& cosine, const T& slope) {
  const T level = constant<T>(1) / sqrt(constant<T>(1) + slope * slope);
  return {-sine * level, slope * level, cosine * level};
}

/// The unit direction seen at a point of the plane.
template <class T>
Vec3<T> direction_at(Lens lens, const PanniniShape& shape, const PlanePoint<T>& at) {
  if (lens == Lens::pannini) {
    const PanniniColumn<T> column = pannini_column(at.x, shape);
    return direction_of(column.sine, column.cosine, at.y / column.up);
  }
  if (lens == Lens::cylindrical) return direction_of(sin(at.x), cos(at.x), at.y);
  const Ray<T> ray = radial_ray(lens, sqrt(at.x * at.x + at.y * at.y));
  return {-at.x * ray.sine_over_radius, at.y * ray.sine_over_radius, ray.cosine};
}

/// The point at which a direction of any length > 0 is seen; finite for all.
template <class T>
PlanePoint<T> point_of(Lens lens, const PanniniShape& shape, const Vec3<T>& d) {
  const T one = constant<T>(1), zero = constant<T>(0);
  if (is_radial(lens)) {
    const Polar<T> polar = polar_of(d);
    const T r = radial_distance(lens, polar);
    return {-polar.x * r, polar.y * r};
  }
  const T level = sqrt(d.x * d.x + d.z * d.z);
  const T slope = d.y / max(level, constant<T>(1e-4) * abs(d.y));
  if (lens == Lens::cylindrical) return {-longitude_of(d), slope};
  const auto off_axis = level > zero;
  const T scale = one / select(off_axis, level, one);
  const T sine = -d.x * scale, cosine = select(off_axis, d.z * scale, one);
  const PanniniColumn<T> column = pannini_column(sine, cosine, shape);
  return {column.across * sine, column.up * slope};
}

/// Solid angle per area of the plane.
template <class T>
T density_at(Lens lens, const PanniniShape& shape, const PlanePoint<T>& at) {
  const T one = constant<T>(1);
  if (is_radial(lens)) return radial_density(lens, sqrt(at.x * at.x + at.y * at.y));
  if (lens == Lens::cylindrical) {
    const T secant2 = one + at.y * at.y;
    return one / (secant2 * sqrt(secant2));
  }
  // dω = cos³β dφ d(tan β), dx/dφ = S² (d cos φ + 1)/(d + 1).
  const PanniniColumn<T> column = pannini_column(at.x, shape);
  const T slope = at.y / column.up, secant2 = one + slope * slope;
  const T stretch = column.across * column.across * (constant<T>(shape.distance) * column.cosine + one) *
                    constant<T>(1 / (shape.distance + 1));
  return one / (secant2 * sqrt(secant2) * stretch * column.up);
}

}  // namespace welkin::sphere
