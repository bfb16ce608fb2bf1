#pragma once

#include "welkin/base/monitor.h"
#include "welkin/lookup/bright_tiles.h"
#include "welkin/lookup/mass_grid.h"

namespace welkin {

/// A map blurred by narrow Gaussians, texel by texel. Internal to lookup.
///
/// The kernel is the von Mises–Fisher lobe of σ², less the B-spline that the masses are spread by: in texels
/// of the grid that has the covariance ¼ I, and the lobe σ² M⁻¹, M being the metric at the blurred texel. So
/// the lobe is multiplied by exp(−½ gᵀ((σ² M⁻¹ − ¼ I)⁻¹ − M/σ²) g). All weights are positive. They are the
/// same on all six faces, and in all eight mirror images of a face: computed once for 48 texels.
///
/// How far they reach depends on how bright something is in their tail, in one of these 48 places: a sun
/// shows where little else does.
struct GaussianBlur {
  int size, margin;     ///< of the results
  double variances[2];  ///< σ²
  double brightest;     ///< what a texel may be, in multiples of the mean
  double tail;          ///< relative error that what the weights don't reach may make in a dark place

  /// Of the weights, in σ, where nothing that they could see is brighter than so many times the mean.
  double reach(double brightness) const;
};

/// How far a result's texels reach into the margin of a grid of `size` texels.
int margin_needed(const GaussianBlur& blur, int size);

/// Both maps, of this size: three values a texel; the fourth is nothing. `bright`: of the masses, in
/// multiples of the means.
void run_blur(const FaceGrid& masses, const BrightTiles& bright, const GaussianBlur& blur, FaceGrid& first,
              FaceGrid& second, const Monitor& monitor);

}  // namespace welkin
