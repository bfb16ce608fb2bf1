#pragma once

#include <cstddef>

/// A parameterization's functions over arrays of float, compiled once per instruction set.
namespace welkin::sphere {

/// Arrays given to kernels hold a multiple of this many values, so that no kernel needs a scalar tail.
inline constexpr std::size_t kLanes = 16;

/// `count` rounded up to whole packs: the capacity that an array for a kernel needs.
constexpr std::size_t padded(std::size_t count) {
  return (count + kLanes - 1) / kLanes * kLanes;
}

/// `self` is the parameterization's struct. Values past `count`, up to padded(count), are read and written
/// too: they must be readable, and need not mean anything. Accuracy: the float laws of
/// parameterization_test.cpp.
struct Kernels {
  void (*to_sphere)(const void* self, int chart, const float* u, const float* v, float* x, float* y, float* z,
                    std::size_t count);
  void (*from_sphere)(const void* self, const float* x, const float* y, const float* z, float* chart,
                      float* u, float* v, std::size_t count);
  void (*density)(const void* self, int chart, const float* u, const float* v, float* density,
                  std::size_t count);
  /// 1 where valid or covered, else 0.
  void (*valid)(const void* self, int chart, const float* u, const float* v, float* mask, std::size_t count);
  void (*covers)(const void* self, const float* x, const float* y, const float* z, float* mask,
                 std::size_t count);
};

/// Kernels of the parameterization at `index` of AllParameterizations, for one instruction set.
const Kernels& kernels_baseline(std::size_t index);
#ifdef WELKIN_HAS_AVX2
const Kernels& kernels_avx2(std::size_t index);
#endif

}  // namespace welkin::sphere
