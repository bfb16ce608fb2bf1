#pragma once

#include "welkin/sphere/parameterization.h"

namespace welkin::sphere {

/// Which way each face of a cube looks, and which way its u and v run, by the OpenGL/Vulkan/D3D look-up rule
/// (native faces, docs/conventions.md). Chart order +X −X +Y −Y +Z −Z.
struct CubeFace {
  Vec3<double> forward, right, down;
};
inline constexpr CubeFace kCubeFaces[6] = {
    {{1, 0, 0}, {0, 0, -1}, {0, -1, 0}}, {{-1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
    {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},   {{0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
    {{0, 0, 1}, {1, 0, 0}, {0, -1, 0}},  {{0, 0, -1}, {-1, 0, 0}, {0, -1, 0}}};

/// The direction through (s, t) ∈ [−1, 1]² of the plane of a face, not normalised: forward + s·right +
/// t·down.
template <class T>
Vec3<T> cube_face_point(int face, T s, T t) {
  const CubeFace& f = kCubeFaces[face];
  const auto axis = [&](double forward, double right, double down) {
    return constant<T>(forward) + constant<T>(right) * s + constant<T>(down) * t;
  };
  return {axis(f.forward.x, f.right.x, f.down.x), axis(f.forward.y, f.right.y, f.down.y),
          axis(f.forward.z, f.right.z, f.down.z)};
}

/// Face, and the point (u, v) ∈ [−1, 1]² of its plane: the longest component picks the face, and divides the
/// others. The inverse of cube_face_point.
template <class T>
ChartPoint<T> cube_face_of(const Vec3<T>& d) {
  const T ax = abs(d.x), ay = abs(d.y), az = abs(d.z);
  const auto x_longest = (ax >= ay) & (ax >= az);
  const auto y_longest = ay >= az;
  const T zero = constant<T>(0), one = constant<T>(1);
  const T longest = select(x_longest, d.x, select(y_longest, d.y, d.z));
  const T side = sign_of(longest);
  const T scale = one / abs(longest);
  const T s = select(x_longest, -side * d.z, select(y_longest, d.x, side * d.x)) * scale;
  const T t = select(x_longest, -d.y, select(y_longest, side * d.z, -d.y)) * scale;
  const T pair = select(x_longest, zero, select(y_longest, constant<T>(2), constant<T>(4)));
  return {pair + select(side < zero, one, zero), s, t};
}

/// Six perspective views of 90°, one texel area for one plane area.
/// Density varies by 3√3 between the centre of a face and its corner (Heidrich & Seidel 1999, §2.2).
struct Cube : WholeWorld {
  static constexpr const char* kName = "cube";
  static constexpr int kCharts = 6;
  static constexpr Traits kTraits{.projection = Projection::lookup, .cube_faces = true, .cube_texture = true};
  double aspect() const { return 1; }

  template <class T>
  Vec3<T> to_sphere(int chart, T u, T v) const {
    const T one = constant<T>(1), two = constant<T>(2);
    return normalize(cube_face_point<T>(chart, two * u - one, two * v - one));
  }

  template <class T>
  ChartPoint<T> from_sphere(const Vec3<T>& d) const {
    const ChartPoint<T> face = cube_face_of(d);
    const T half = constant<T>(0.5);
    return {face.chart, half + half * face.u, half + half * face.v};
  }

  /// dω = dA / (1 + s² + t²)^(3/2), and dA = 4 du dv.
  template <class T>
  T solid_angle_density(int, T u, T v) const {
    const T one = constant<T>(1), two = constant<T>(2);
    const T s = two * u - one, t = two * v - one;
    const T r2 = one + s * s + t * t;
    return constant<T>(4) / (r2 * sqrt(r2));
  }
};

}  // namespace welkin::sphere
