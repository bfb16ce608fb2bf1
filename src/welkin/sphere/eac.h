#pragma once

#include "welkin/sphere/cube.h"

namespace welkin::sphere {

/// The equi-angular cube (Google 2017): the cube with a face's plane coordinate s = tan(π/4 · (2u − 1)), so
/// that u is linear in the angle. Faces as Cube. Density varies by √2, between the
/// centre of a face and the middle of its edges.
/// Past an edge u still measures the angle, and stops just short of 90° from the face's centre.
struct EquiAngularCube : WholeWorld {
  static constexpr const char* kName = "eac";
  static constexpr int kCharts = 6;
  static constexpr Traits kTraits{.projection = Projection::lookup, .cube_faces = true};
  double aspect() const { return 1; }

  template <class T>
  Vec3<T> to_sphere(int chart, T u, T v) const {
    return normalize(cube_face_point<T>(chart, tan(angle(u)), tan(angle(v))));
  }

  template <class T>
  ChartPoint<T> from_sphere(const Vec3<T>& d) const {
    const T half = constant<T>(0.5), scale = constant<T>(2 / kPi);
    const ChartPoint<T> face = cube_face_of(d);
    return {face.chart, half + scale * atan(face.u), half + scale * atan(face.v)};
  }

  /// The cube's dω = ds dt / (1 + s² + t²)^(3/2), and ds = π/2 (1 + s²) du.
  template <class T>
  T solid_angle_density(int, T u, T v) const {
    const T one = constant<T>(1);
    const T s = tan(angle(u)), t = tan(angle(v));
    const T r2 = one + s * s + t * t;
    return constant<T>(kPi * kPi / 4) * (one + s * s) * (one + t * t) / (r2 * sqrt(r2));
  }

 private:
  /// π/4 · (2u − 1), its tangent at most 50.
  template <class T>
  static T angle(T u) {
    const T limit = constant<T>(1.5508);
    return clamp(constant<T>(kPi / 2) * (u - constant<T>(0.5)), -limit, limit);
  }
};

}  // namespace welkin::sphere
