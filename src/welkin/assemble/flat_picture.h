#pragma once

#include "welkin/sphere/parameterization.h"

namespace welkin {

/// A perspective picture: the plane z = 1 seen from the origin. Centre +Z, right −X, up +Y, seen from inside.
/// Past its edges the plane continues. Call update() after changing a parameter.
struct FlatPicture {
  static constexpr const char* kName = "flat-picture";
  static constexpr int kCharts = 1;
  double fov = 90;         ///< horizontal field of view, degrees, edge to edge
  double proportions = 1;  ///< width over height

  /// Of that field of view and width over height.
  explicit FlatPicture(double horizontal_fov = 90, double width_over_height = 1)
      : fov(horizontal_fov), proportions(width_over_height) {
    update();
  }

  double aspect() const { return proportions; }  ///< width over height

  /// Derives what the functions need.
  void update() {
    across = std::tan(fov * (kPi / 360));
    down = across / proportions;
  }

  /// Shows the parameters.
  template <class Visitor>
  void visit_parameters(Visitor&& visit) {
    visit("fov", fov, 0.001, 179.0, "horizontal field of view, degrees");
    visit("aspect", proportions, 1e-4, 1e4, "width over height");
    update();
  }

  /// As parameterization.h has them.
  /// @{
  template <class T>
  Vec3<T> to_sphere(int, T u, T v) const {
    const T one = constant<T>(1), two = constant<T>(2);
    return normalize(
        Vec3<T>{constant<T>(across) * (one - two * u), constant<T>(down) * (one - two * v), one});
  }
  template <class T>
  sphere::ChartPoint<T> from_sphere(const Vec3<T>& d) const {
    const T half = constant<T>(0.5);
    const T scale = constant<T>(1) / max(d.z, constant<T>(kBehind) * length(d));
    return {constant<T>(0), half - constant<T>(0.5 / across) * d.x * scale,
            half - constant<T>(0.5 / down) * d.y * scale};
  }
  /// dω = dA/|p|³ on the plane at distance 1.
  template <class T>
  T solid_angle_density(int, T u, T v) const {
    const T one = constant<T>(1), two = constant<T>(2);
    const T x = constant<T>(across) * (one - two * u), y = constant<T>(down) * (one - two * v);
    const T r2 = one + x * x + y * y;
    return constant<T>(4 * across * down) / (r2 * sqrt(r2));
  }
  template <class T>
  Mask<T> valid(int, T u, T) const {
    return u == u;
  }
  template <class T>
  Mask<T> covers(const Vec3<T>& d) const {
    const auto in_front = d.z > constant<T>(0);
    const auto within = abs(d.x) <= constant<T>(across) * d.z, below = abs(d.y) <= constant<T>(down) * d.z;
    return in_front & within & below;
  }
  /// The solid angle of a rectangle's pyramid.
  double coverage() const {
    return 4 * std::asin(across * down / std::sqrt((1 + across * across) * (1 + down * down)));
  }
  /// @}

 private:
  static constexpr double kBehind = 1e-4;  ///< the least z over length that positions are computed of
  double across = 1, down = 1;             ///< half the picture's sides on the plane
};

}  // namespace welkin
