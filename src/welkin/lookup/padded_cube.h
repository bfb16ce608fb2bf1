#pragma once

#include <type_traits>

#include "welkin/sphere/cube.h"

namespace welkin {

/// The equi-angular cube whose charts go on past their edges by kMargin texels: faces overlap. What
/// pre-filters fill such charts with needs no borders. Only for making texels: nothing looks directions up in
/// it.
struct PaddedCube : sphere::WholeWorld {
  static constexpr const char* kName = "padded-equi-angular-cube";
  static constexpr int kCharts = 6;
  static constexpr int kMargin = 6;
  static constexpr sphere::Traits kTraits{.follows_size = true};
  double width = 64, height = 64;  ///< texels of a chart, margins included

  void visit_parameters(auto&& visit) {
    visit("width", width, 2 * kMargin + 1.0, 1048576.0, "texels across a chart");
    visit("height", height, 2 * kMargin + 1.0, 1048576.0, "texels down a chart");
  }

  double aspect() const { return 1; }

  template <class T>
  Vec3<T> to_sphere(int chart, T u, T v) const {
    return normalize(sphere::cube_face_point<T>(chart, tangent(angle(u)), tangent(angle(v))));
  }
  template <class T>
  sphere::ChartPoint<T> from_sphere(const Vec3<T>& d) const {
    const T half = constant<T>(0.5), scale = constant<T>(2 / kPi / stretch());
    const sphere::ChartPoint<T> face = sphere::cube_face_of(d);
    return {face.chart, half + scale * atan(face.u), half + scale * atan(face.v)};
  }
  template <class T>
  T solid_angle_density(int, T u, T v) const {
    const T one = constant<T>(1);
    const T s = tan(angle(u)), t = tan(angle(v));
    const T r2 = one + s * s + t * t;
    return constant<T>(kPi * kPi / 4 * stretch() * stretch()) * (one + s * s) * (one + t * t) /
           (r2 * sqrt(r2));
  }

 private:
  double stretch() const { return width / (width - 2 * kMargin); }
  /// Of |a| < 1.56. For floats without a call, so that loops over texels become vector code: sine over
  /// cosine, as many terms of their series as matter.
  template <class T>
  static T tangent(T a) {
    if constexpr (std::is_same_v<T, float>) {
      const float a2 = a * a;
      const float sine =
          1 + a2 * (-1.0f / 6 +
                    a2 * (1.0f / 120 + a2 * (-1.0f / 5040 + a2 * (1.0f / 362880 + a2 * (-1.0f / 39916800)))));
      const float cosine =
          1 +
          a2 * (-1.0f / 2 +
                a2 * (1.0f / 24 + a2 * (-1.0f / 720 + a2 * (1.0f / 40320 + a2 * (-1.0f / 3628800 +
                                                                                 a2 * (1.0f / 479001600))))));
      return a * sine / cosine;
    } else {
      return tan(a);
    }
  }
  template <class T>
  T angle(T u) const {
    const T limit = constant<T>(1.55);
    return clamp(constant<T>(kPi / 2 * stretch()) * (u - constant<T>(0.5)), -limit, limit);
  }
};

}  // namespace welkin
