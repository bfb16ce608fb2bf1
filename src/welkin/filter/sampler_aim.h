#pragma once

#include <cstddef>

#include "welkin/math/rotation.h"
#include "welkin/sphere/kernels.h"

/// The first step of a look-up: from the caller's directions to those of the parameterization, in float. One
/// source file per instruction set.
namespace welkin {

/// A map's orientation, in float.
struct FloatOrientation {
  explicit FloatOrientation(const Matrix3& matrix);

  bool identity;
  float m[3][3];
};

/// Directions in memory: component c of direction i is c[i·stride], c = x, y, z.
struct StridedDirections {
  const float *x, *y, *z;
  std::size_t stride;
};

/// Directions as kernels take them, structure of arrays; each has room for padded(count) values.
struct AimedDirections {
  float *x, *y, *z;
  float* usable;  ///< 1, or 0 where the direction was zero or not finite; it is replaced by +Z then
};

/// Scales each direction by a power of two, so that its longest component is between 1 and 2 and no formula
/// overflows or loses digits (for the largest and for subnormal numbers: between 2^−22 and 4), and rotates
/// it. Values of `to` up to the next whole pack are written. Returns whether all are usable.
///
/// A direction gives the same bits alone, among others and in any pack. The rotation adds an error of at most
/// 2e-7.
using Aim = bool (*)(const FloatOrientation& orientation, const StridedDirections& from,
                     const AimedDirections& to, std::size_t count);

/// The same for one direction (x, y, z), where every instruction counts: `to` is aligned to 64 bytes and gets
/// x at 0, y at kLanes and z at 2·kLanes, each for a whole pack. Returns whether it is usable.
using AimOne = bool (*)(const FloatOrientation& orientation, const float* direction, float* to);

struct AimKernels {
  Aim many;
  AimOne one;
};

AimKernels aim_kernels_baseline();
#ifdef WELKIN_HAS_AVX2
AimKernels aim_kernels_avx2();
#endif

/// For the best instruction set of this processor.
AimKernels aim_kernels();

}  // namespace welkin
