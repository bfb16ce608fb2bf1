#pragma once

#include <cstddef>

#include "welkin/math/vec.h"

/// Weights of the elliptical weighted average over arrays of directions. One source file per instruction set.
namespace welkin {

/// exp(−½ d²) for d² = pᵀ Q p up to `reach`², 0 beyond; p where a unit direction lies in the plane of the
/// logarithm map at `normal`.
struct EllipticalWeight {
  Vec3<float> normal, right, down;
  float xx, xy, yy;  ///< Q, of which xy counts twice
  float reach;
};

/// weights[i] of directions (x[i], y[i], z[i]), i < count; arrays are aligned to 64 bytes and hold
/// sphere::padded(count) values, all of which are read and written. Absolute error 2e-5 for σ of 0.01 and
/// more; what 1e-7 in a direction moves it by is more where σ is smaller.
using WeighDirections = void (*)(const EllipticalWeight& weight, const float* x, const float* y,
                                 const float* z, float* weights, std::size_t count);

WeighDirections weigh_directions_baseline();
#ifdef WELKIN_HAS_AVX2
WeighDirections weigh_directions_avx2();
#endif

/// For the best instruction set of this processor.
WeighDirections weigh_directions();

}  // namespace welkin
