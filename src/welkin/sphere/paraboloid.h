#pragma once

#include "welkin/sphere/disc.h"

namespace welkin::sphere {

/// Dual paraboloids f(x, y) = ½ − ½(x² + y²) (Heidrich & Seidel 1999, eq. 1), one disc for each half of the
/// world. Chart 0 is the front, centre +Z, right −X, up +Y; chart 1 the back, centre −Z, right +X, up +Y:
/// both seen from inside, which is the look-up (x, y) = d.xy / (1 + |d.z|) with x negated on the front.
///
/// The discs alone are valid: they share the world without overlap. Outside a disc, in the chart's corners
/// and its margin, the paraboloid continues over the other half, so both pictures can be filled to their
/// edges for filtering and blending. Density varies by 4 between the centre and the rim (eq. 3).
struct DualParaboloid : WholeWorld {
  static constexpr const char* kName = "paraboloid";
  static constexpr int kCharts = 2;
  static constexpr Traits kTraits{.projection = Projection::lookup, .filled_to_edges = true};
  double aspect() const { return 1; }

  /// d = (x, y, f)/|(x, y, f)|, whose length is ½(1 + r²).
  template <class T>
  Vec3<T> to_sphere(int chart, T u, T v) const {
    const T one = constant<T>(1), forward = constant<T>(chart == 0 ? 1 : -1);
    const DiscPoint<T> p = disc_point(u, v);
    const T r2 = p.radius * p.radius;
    const T scale = one / (one + r2);
    const T twice = scale + scale;
    return {-forward * p.right * twice, p.up * twice, forward * (one - r2) * scale};
  }

  template <class T>
  ChartPoint<T> from_sphere(const Vec3<T>& d) const {
    const T zero = constant<T>(0), one = constant<T>(1), half = constant<T>(0.5);
    const T scale = half / (length(d) + abs(d.z));
    const auto back = d.z < zero;
    return {select(back, one, zero), half + select(back, d.x, -d.x) * scale, half - d.y * scale};
  }

  /// dω = 4 dA / (1 + r²)², and dA = 4 du dv.
  template <class T>
  T solid_angle_density(int, T u, T v) const {
    const T radius = disc_point(u, v).radius;
    const T side = constant<T>(1) + radius * radius;
    return constant<T>(16) / (side * side);
  }

  template <class T>
  Mask<T> valid(int, T u, T v) const {
    return disc_point(u, v).radius <= constant<T>(1);
  }
};

}  // namespace welkin::sphere
