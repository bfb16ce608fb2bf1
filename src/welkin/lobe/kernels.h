#pragma once

#include <cstddef>

#include "welkin/lobe/lobe.h"

/// The lobes' functions over arrays, compiled once per instruction set.
namespace welkin::lobe {

/// Adds Σ_i weights[i] P_l(1 − s[i]) to sums[l], l = 0 … degree. `count` is a multiple of kLanes; 0 ≤ s ≤ 1.
using LegendreSums = void (*)(const double* s, const double* weights, std::size_t count, int degree,
                              double* sums);

/// Arrays of float that a Weights is given hold a multiple of this many values.
inline constexpr std::size_t kLanes = 16;

/// `index` is the index in AllLobes.
Weights weights_baseline(std::size_t index);
Weights weights_avx2(std::size_t index);
PointSums point_sums_baseline(std::size_t index);
PointSums point_sums_avx2(std::size_t index);
LegendreSums legendre_sums_baseline();
LegendreSums legendre_sums_avx2();

}  // namespace welkin::lobe
