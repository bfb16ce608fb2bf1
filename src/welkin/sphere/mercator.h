#pragma once

#include "welkin/sphere/parameterization.h"
#include "welkin/sphere/polar.h"

namespace welkin::sphere {

/// Mercator's projection around +Y: u = ½ − atan2(x, z)/2π as LatLong, v linear in the ordinate m =
/// asinh(tan(latitude)), which is ±asinh(tan(fov/2)) at the top and bottom edges. It is conformal. Past the
/// edges it continues toward the poles. The default fov is that of web maps, whose ordinate of π makes them
/// square. Call update() after changing `fov` (vertical, degrees, < 180).
struct Mercator {
  static constexpr const char* kName = "mercator";
  static constexpr int kCharts = 1;
  static constexpr Traits kTraits{.projection = Projection::panorama, .density_by_row = true};
  static constexpr double kSquareFov = 170.1022575596132;  ///< 2 atan(sinh π), degrees
  double fov = kSquareFov;

  explicit Mercator(double fov_degrees = kSquareFov) : fov(fov_degrees) { update(); }
  double aspect() const { return kPi / top; }

  void update() {
    top = std::asinh(std::tan(fov * (kPi / 360)));
    top_sine = std::sin(fov * (kPi / 360));
    top_tangent = std::tan(fov * (kPi / 360));
  }

  template <class Visitor>
  void visit_parameters(Visitor&& visit) {
    visit("fov", fov, 1.0, 179.0, "vertical field of view, degrees");
    update();
  }
  template <class Visitor>
  void visit_parameters(Visitor&& visit) const {
    visit("fov", fov, 1.0, 179.0, "vertical field of view, degrees");
  }

  /// sin(latitude) = tanh m and cos(latitude) = 1/cosh m, by e^−|m|.
  template <class T>
  Vec3<T> to_sphere(int, T u, T v) const {
    const T half = constant<T>(0.5), longitude = constant<T>(2 * kPi) * (half - u);
    const T decay = exp(-abs(ordinate(v))), decay2 = decay * decay, one = constant<T>(1);
    const T scale = one / (one + decay2), cosine = (decay + decay) * scale;
    return {sin(longitude) * cosine, copysign((one - decay2) * scale, half - v), cos(longitude) * cosine};
  }

  /// The tangent of the latitude is taken as at most 10⁶.
  template <class T>
  ChartPoint<T> from_sphere(const Vec3<T>& d) const {
    const T half = constant<T>(0.5), across2 = d.x * d.x + d.z * d.z;
    const T across = max(sqrt(across2), constant<T>(1e-6) * abs(d.y));
    const T up = log((abs(d.y) + sqrt(across2 + d.y * d.y)) / across);
    return {constant<T>(0), half - constant<T>(0.5 / kPi) * longitude_of(d),
            half - copysign(constant<T>(0.5 / top) * up, d.y)};
  }

  /// dω = cos²(latitude) dm dλ.
  template <class T>
  T solid_angle_density(int, T, T v) const {
    const T decay = exp(-abs(ordinate(v))), side = constant<T>(1) + decay * decay;
    return constant<T>(16 * kPi * top) * decay * decay / (side * side);
  }

  template <class T>
  Mask<T> valid(int, T u, T) const {
    return u == u;
  }
  template <class T>
  Mask<T> covers(const Vec3<T>& d) const {
    return abs(d.y) <= constant<T>(top_tangent) * sqrt(d.x * d.x + d.z * d.z);
  }
  double coverage() const { return 4 * kPi * top_sine; }

 private:
  template <class T>
  T ordinate(T v) const {
    return constant<T>(2 * top) * (constant<T>(0.5) - v);
  }

  double top = 0, top_sine = 0,
         top_tangent = 0;  ///< ordinate, and sine and tangent of the latitude, at the top
};

}  // namespace welkin::sphere
