#pragma once

#include <cstddef>

#include "welkin/filter/filter.h"
#include "welkin/map/map.h"

/// Reading texels of a level at positions (chart, u, v), many at a time. One source file per instruction set.
namespace welkin {

/// What a fetch kernel needs of a level.
struct LevelView {
  const float* texels = nullptr;  ///< texel (0, 0) of chart 0
  std::ptrdiff_t row_stride = 0;
  std::ptrdiff_t chart_stride = 0;
  int charts = 0;
  int width = 0;
  int height = 0;
  int channels = 0;
};

LevelView view_of(const Level& level);

/// out[i·channels…] = the filtered texels at (chart[i], u[i], v[i]), i < count. Values of the arrays up to
/// padded(count) are read (sphere::kLanes); their values are ignored. `out` has room for count·channels + 8
/// values; what comes after the first count·channels is overwritten. Positions are clamped to within half a
/// texel outside the chart, so a bad one (NaN too) reads some texel of the map and no other memory.
using Fetch = void (*)(const LevelView& level, const float* chart, const float* u, const float* v, float* out,
                       std::size_t count);

/// A kernel with negative weights. Unclamped, it overshoots beside a bright light. Clamped, a result lies at
/// most half the range of the inner 4×4 texels beyond that range, and never below half the smallest of them,
/// so positive radiance stays positive.
struct RingingFetch {
  Fetch unclamped;
  Fetch clamped;
};

struct FetchKernels {
  Fetch nearest;          ///< of the chart, never of its border
  Fetch bilinear;         ///< tent over 2×2 texels
  Fetch b_spline;         ///< cubic B-spline, 4×4 texels that hold its coefficients, not values
  RingingFetch bicubic;   ///< Keys 1981, a = −½ (Catmull–Rom), 4×4 texels
  RingingFetch lanczos3;  ///< 6×6 texels
  RingingFetch lanczos4;  ///< 8×8 texels
};

FetchKernels fetch_kernels_baseline(int channels);
#ifdef WELKIN_HAS_AVX2
FetchKernels fetch_kernels_avx2(int channels);
#endif

/// For the best instruction set of this processor.
FetchKernels fetch_kernels(int channels);

/// The kernel of a filter for single look-ups, where there is no area to average over: `automatic` means
/// `bicubic`.
Fetch fetch_for(Filter filter, bool allow_ringing, int channels);

}  // namespace welkin
