#pragma once

#include <concepts>

#include "welkin/math/vec.h"
#include "welkin/sphere/traits.h"

/// @file
/// What a parameterization provides.

namespace welkin::sphere {

/// A position in a map: a chart and a point of its square [0,1]².
template <class T>
struct ChartPoint {
  T chart;  ///< the chart's number, of type T so that a SIMD pack can hold a different one in every lane
  T u;      ///< to the right
  T v;      ///< down
};

// clang-format off
/// A parameterization says where a direction lies in a picture. One struct each, written once for double, float and
/// SIMD packs, branch-free:
///
///     struct Name {
///       static constexpr const char* kName = "name";
///       static constexpr int kCharts = 1;             // square domains [0,1]²
///       static constexpr Traits kTraits{…};           // optional: what others need to know of it (traits.h)
///       double aspect() const;                        // width / height of a chart with square texels
///
///       // Unit direction at (u, v). Defined on the chart and, continuously, in a margin of a whole chart width
///       // around it: past its edge a chart goes on over the sphere, so that a border can be filled
///       // (docs/decisions/0004-borders.md). `chart` is a plain number: one chart per call.
///       template <class T> Vec3<T> to_sphere(int chart, T u, T v) const;
///
///       // The chart and position of a direction of any length > 0 (unless it says otherwise).
///       template <class T> ChartPoint<T> from_sphere(const Vec3<T>& d) const;
///
///       // Solid angle per unit of (u, v) area, sr. Inside the chart.
///       template <class T> T solid_angle_density(int chart, T u, T v) const;
///
///       // Whether (u, v) is a position of the map: false in the corners of a disc.
///       template <class T> Mask<T> valid(int chart, T u, T v) const;
///
///       // Whether the map shows this direction: false behind a hemisphere. from_sphere is finite all the same.
///       template <class T> Mask<T> covers(const Vec3<T>& d) const;
///
///       // What the covered part of the sphere measures, sr: 4π for a whole world.
///       double coverage() const;
///     };
///
/// parameterization_test.cpp holds every registered one to: inverse both ways, density against finite differences,
/// ∫density = coverage, continuity across every edge, and float and SIMD against double.
// clang-format on
template <class P>
concept Parameterization = requires(const P& p, int chart, double x, const Vec3<double>& d) {
  { P::kName } -> std::convertible_to<const char*>;
  { P::kCharts } -> std::convertible_to<int>;
  { p.aspect() } -> std::convertible_to<double>;
  { p.to_sphere(chart, x, x) } -> std::same_as<Vec3<double>>;
  { p.from_sphere(d) } -> std::same_as<ChartPoint<double>>;
  { p.solid_angle_density(chart, x, x) } -> std::same_as<double>;
  { p.valid(chart, x, x) } -> std::same_as<bool>;
  { p.covers(d) } -> std::same_as<bool>;
  { p.coverage() } -> std::convertible_to<double>;
};

/// The traits of a parameterization: its own, or the defaults.
template <class P>
constexpr Traits traits_of() {
  if constexpr (requires { P::kTraits; }) {
    return P::kTraits;
  } else {
    return {};
  }
}

/// @cond INTERNAL
/// The struct whose functions are compiled as the kernels of P: a base of it that several share, and names as
/// `KernelStruct`, or itself.
template <class P>
struct KernelStructOf {
  using Type = P;
};
template <class P>
requires requires {
  typename P::KernelStruct;
}
struct KernelStructOf<P> {
  using Type = typename P::KernelStruct;
};
/// @endcond

/// For a parameterization whose charts are full and cover the whole sphere: inherit these.
struct WholeWorld {
  /// True everywhere.
  template <class T>
  Mask<T> valid(int, T u, T) const {
    return u == u;
  }
  /// True for every direction.
  template <class T>
  Mask<T> covers(const Vec3<T>& d) const {
    return d.x == d.x;
  }
  /// 4π sr.
  double coverage() const { return 4 * kPi; }
};

}  // namespace welkin::sphere
