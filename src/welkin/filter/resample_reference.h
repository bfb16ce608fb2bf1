#pragma once

#include <span>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/filter/resample.h"

/// @file
/// Resampling in float64, to measure against.
namespace welkin {

/// What resample() is measured against: the same contract in float64, one position after another.
///
/// Nearest, bilinear, bicubic and lanczos are one look-up per texel through AnyParameterization's double
/// functions, with kernel weights in double, from the source's texels and borders.
///
/// `automatic` is the mean over the texel's solid angle of what is reconstructed within the source's texels
/// (docs/filtering.md), or of the texels as they are where resample() takes them so: samples × samples points
/// on a regular grid, each weighted by the target's density there; what differs from a source texel's mean
/// within it is weighted so that it adds up to nothing over the texel. No pyramid is read, so it tends to the
/// exact mean as `samples` grows; there should be several points per source texel.
///
/// Directions that the source does not show count as `fill`, and so does a texel none of whose points is a
/// position of the target. Fills the target's charts, not its borders. samples ≥ 1; both maps have the same
/// number of channels. Error: float rounding of the result. Throws Cancelled.
WELKIN_API void resample_reference(const Map& source, Map& target, const ResampleOptions& options,
                                   int samples);

/// A texel of a map.
struct TexelPlace {
  int chart = 0;  ///< which chart
  int x = 0;      ///< its column
  int y = 0;      ///< its row
};

/// The same of some texels of a map that need not exist: a value for each of the source's channels, texel by
/// texel. Throws Error (bad_request) for a texel that the map doesn't have.
WELKIN_API std::vector<double> resample_reference(const Map& source, const MapFrame& target,
                                                  const ResampleOptions& options, int samples,
                                                  std::span<const TexelPlace> texels);

}  // namespace welkin
