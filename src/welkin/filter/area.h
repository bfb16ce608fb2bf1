#pragma once

#include <cstddef>

#include "welkin/filter/fetch.h"

namespace welkin {

/// A parallelogram of a level over which texels are averaged: all of a target texel's area, seen in the
/// source. Positions in texels of the level, centres at +½. A position (x, y) has coordinates a =
/// across·(x−centre), b = down·(x−centre), each −½…½ inside the parallelogram.
struct Parallelogram {
  int chart;
  float x, y;         ///< centre
  float across[2];    ///< gradient of a
  float down[2];      ///< gradient of b
  float gradient[2];  ///< the weight of a position is 1 + gradient[0]·a + gradient[1]·b
};

/// out[i·channels…] = the weighted mean over parallelogram i of the level's bilinear interpolation: every
/// texel is read once, with the overlap of its tent and the parallelogram, both measured perpendicular to the
/// parallelogram's sides (exact where these are parallel to the texel grid). Parallelograms must lie inside
/// the chart and its border, by one texel. `out` has room for count·channels + 8 values.
using AreaMean = void (*)(const LevelView& level, const Parallelogram* areas, float* out, std::size_t count);

AreaMean area_mean_baseline(int channels);
#ifdef WELKIN_HAS_AVX2
AreaMean area_mean_avx2(int channels);
#endif

/// For the best instruction set of this processor.
AreaMean area_mean(int channels);

}  // namespace welkin
