#pragma once

#include "welkin/sphere/fisheye_lens.h"

namespace welkin::sphere {

/// r proportional to θ.
struct FisheyeEquidistant : Fisheye<FisheyeEquidistant> {
  static constexpr const char* kName = "fisheye-equidistant";
  static constexpr double kWidest = 360;
  using Fisheye::Fisheye;
  static double scale_of(double half_fov) { return half_fov; }

  template <class T>
  Ray<T> ray(T radius) const {
    return {sine_ratio(constant<T>(scale), radius), cos(constant<T>(scale) * radius)};
  }
  template <class T>
  T radius(const Polar<T>& polar) const {
    return polar.angle() * constant<T>(1 / scale);
  }
  template <class T>
  T density(T radius) const {
    return constant<T>(4 * scale) * sine_ratio(constant<T>(scale), radius);
  }
};

/// r proportional to sin(θ/2): every texel measures the same solid angle.
struct FisheyeEquisolid : Fisheye<FisheyeEquisolid> {
  static constexpr const char* kName = "fisheye-equisolid";
  static constexpr double kWidest = 360;
  using Fisheye::Fisheye;
  static double scale_of(double half_fov) { return std::sin(half_fov / 2); }

  template <class T>
  Ray<T> ray(T radius) const {
    const T two = constant<T>(2), s = constant<T>(scale);
    const Arc<T> half = arc_of_sine(s * radius);
    return {two * half.cosine * half.ratio * s, constant<T>(1) - two * half.sine * half.sine};
  }
  template <class T>
  T radius(const Polar<T>& polar) const {
    return polar.half_sine() * constant<T>(1 / scale);
  }
  template <class T>
  T density(T) const {
    return constant<T>(16 * scale * scale);
  }
};

/// r proportional to sin θ: the orthographic projection of the hemisphere. At 180° the rim is
/// singular: its density is infinite, and given as at most 10⁴ times the centre's, and a rounding error e of
/// (u, v) turns the direction by √e.
struct FisheyeOrthographic : Fisheye<FisheyeOrthographic> {
  static constexpr const char* kName = "fisheye-orthographic";
  static constexpr double kWidest = 180;
  using Fisheye::Fisheye;
  static double scale_of(double half_fov) { return std::sin(half_fov); }

  template <class T>
  Ray<T> ray(T radius) const {
    const T s = constant<T>(scale);
    const Arc<T> arc = arc_of_sine(s * radius);
    return {s * arc.ratio, arc.cosine};
  }
  /// Directions behind the camera lie past the rim, where `ray` continues: 2 − sin θ.
  template <class T>
  T radius(const Polar<T>& polar) const {
    const auto behind = polar.cosine < constant<T>(0);
    return select(behind, constant<T>(2) - polar.sine, polar.sine) * constant<T>(1 / scale);
  }
  template <class T>
  T density(T radius) const {
    const T cosine = abs(arc_of_sine(constant<T>(scale) * radius).cosine);
    return constant<T>(4 * scale * scale) / max(cosine, constant<T>(1e-4));
  }
};

/// r proportional to tan(θ/2): circles stay circles.
struct FisheyeStereographic : Fisheye<FisheyeStereographic> {
  static constexpr const char* kName = "fisheye-stereographic";
  static constexpr double kWidest = 359;
  using Fisheye::Fisheye;
  static double scale_of(double half_fov) { return std::tan(half_fov / 2); }

  template <class T>
  Ray<T> ray(T radius) const {
    const T one = constant<T>(1), t = constant<T>(scale) * radius;
    const T part = one / (one + t * t);
    return {constant<T>(2 * scale) * part, (one - t * t) * part};
  }
  template <class T>
  T radius(const Polar<T>& polar) const {
    return polar.half_tangent() * constant<T>(1 / scale);
  }
  template <class T>
  T density(T radius) const {
    const T t = constant<T>(scale) * radius, part = constant<T>(1) + t * t;
    return constant<T>(16 * scale * scale) / (part * part);
  }
};

}  // namespace welkin::sphere
