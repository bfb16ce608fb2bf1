#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "welkin/base/large_memory.h"
#include "welkin/base/monitor.h"
#include "welkin/lookup/gaussian_stack.h"
#include "welkin/map/map.h"

/// The levels of a GaussianStack. Internal to lookup.
///
/// Between σ_first and 90°, σ² is divided into intervals of one ratio. Of each interval two blurred maps are
/// kept, at the two σ² inside it for which a line through them has the least error over it (Chebyshev's
/// nodes); as pairs of texels side by side, so that one look-up reads both. A grid is an equi-angular cube,
/// in the world's frame, of coefficients of quadratic B-splines, with a border of one.
namespace welkin {

/// What an accuracy means.
struct GaussianQuality {
  double step;          ///< log2 of the ratio of σ² over an interval
  double density;       ///< grid texels in an interval's least σ
  double finest;        ///< σ_first over the side of a mean texel of the map
  double fine_step;     ///< as `step`, of intervals narrower than a texel
  double fine_density;  ///< as `density`, of those
  double spacing;       ///< of the taps along a long axis (gaussian_taps.h)
  double hermite;       ///< how much wider the Gauss–Hermite rules are used than for 0.1 %
  double ratio;         ///< side of the texels that a level is made from, in σ (gaussian_blur.h)
  double fine_ratio;    ///< as `ratio`, of intervals narrower than a texel
  double handover;      ///< σ in mean texels of the map from which on levels are made by the pre-filter
  double blur_tail;     ///< as `tail`, of the weights of a blur
  double tail;          ///< relative error that a light past the reach of the taps may make in a dark place
  double tolerance;     ///< of the pre-filter
};
GaussianQuality quality_of(GaussianAccuracy accuracy);

struct GaussianInterval {
  float lowest;        ///< σ²
  float node;          ///< σ² of the first of the pair
  float wider;         ///< that of the second
  float flank;         ///< from which ratio of the second to the first on they are a Gaussian's flank
  float per_variance;  ///< 1 / (σ² of the second − the first)
  std::int32_t size;   ///< texels of a face's side, without borders
  std::int32_t reach;  ///< GaussianTapRules' index of the reach that its brightest texel asks for
  std::int64_t first;  ///< its first texel, counted from the stack's first
};

/// One for each channel.
struct ChannelScale {
  float mean;      ///< of the map over the sphere; what it does not show is black
  float size;      ///< the mean of its absolute value; 1 where that is 0
  float contrast;  ///< the largest absolute value of a texel over `size`
  float scale;     ///< radiance of a stored 1
  bool positive;   ///< no texel of the map is negative
};

struct GaussianLevels {
  int channels = 0;
  double texel = 0;  ///< side of a mean texel of the map, radians
  std::vector<GaussianInterval> intervals;
  float highest = 0;  ///< σ² where the last one ends
  std::vector<ChannelScale> scales;
  std::size_t texels = 0;
  LargeMemory halves;  ///< [texel][2][channels], IEEE half precision, and 64 bytes more

  const std::uint16_t* values() const { return reinterpret_cast<const std::uint16_t*>(halves.data()); }
};

GaussianLevels make_gaussian_levels(const Map& map, GaussianAccuracy accuracy, const Monitor& monitor);

}  // namespace welkin
