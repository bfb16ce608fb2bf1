#pragma once

#include <cstddef>

/// @file
/// A parameterization's functions over arrays of float, compiled once per instruction set.
namespace welkin::sphere {

/// Arrays given to kernels hold a multiple of this many values, so that no kernel needs a scalar tail.
inline constexpr std::size_t kLanes = 16;

/// `count` rounded up to whole packs: the capacity that an array for a kernel needs.
constexpr std::size_t padded(std::size_t count) {
  return (count + kLanes - 1) / kLanes * kLanes;
}

/// The functions of parameterization.h over arrays, which do not overlap. `self` is the parameterization's
/// struct: AnyParameterization::self. Values past `count`, up to padded(count), are read and written
/// too: they must be readable and writable, and need not mean anything.
/// Maximum errors, against the double functions: directions 3e-7, beside what rounding (u, v) to float moves
/// them; positions 3e-7 of a chart's side, beside what 3e-7 in the direction moves them; densities 5e-6 of
/// their value and 4e-7 of the average, at 0.005 and more from the edge of the valid domain.
struct Kernels {
  /// Unit directions at positions (u, v) of one chart.
  void (*to_sphere)(const void* self, int chart, const float* u, const float* v, float* x, float* y, float* z,
                    std::size_t count);
  /// Chart numbers and positions of directions of any length > 0.
  void (*from_sphere)(const void* self, const float* x, const float* y, const float* z, float* chart,
                      float* u, float* v, std::size_t count);
  /// Solid angle per unit of (u, v) area, sr.
  void (*density)(const void* self, int chart, const float* u, const float* v, float* density,
                  std::size_t count);
  /// 1 where a position is of the map, else 0.
  void (*valid)(const void* self, int chart, const float* u, const float* v, float* mask, std::size_t count);
  /// 1 where the map shows a direction, else 0.
  void (*covers)(const void* self, const float* x, const float* y, const float* z, float* mask,
                 std::size_t count);
};

/// @cond INTERNAL
/// Kernels of the parameterization at `index` of AllParameterizations, for one instruction set.
const Kernels& kernels_baseline(std::size_t index);
#ifdef WELKIN_HAS_AVX2
const Kernels& kernels_avx2(std::size_t index);
#endif
/// @endcond

}  // namespace welkin::sphere
