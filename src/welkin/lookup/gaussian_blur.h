#pragma once

#include "welkin/base/monitor.h"
#include "welkin/lookup/mass_grid.h"

namespace welkin {

/// A map blurred by narrow Gaussians, texel by texel. Internal to lookup.
///
/// The kernel is the von Mises–Fisher lobe of σ², less the B-spline that the masses are spread by: in texels
/// of the grid that has the covariance ¼ I, and the lobe σ² M⁻¹, M being the metric at the blurred texel. So
/// the lobe is multiplied by exp(−½ gᵀ((σ² M⁻¹ − ¼ I)⁻¹ − M/σ²) g). All weights are positive. They are the
/// same on all six faces, and in all eight mirror images of a face: computed once for 48 texels.
struct GaussianBlur {
  int size, margin;     ///< of the results
  double variances[2];  ///< σ²
  double reach;         ///< of the weights, in σ
};

/// How far a result's texels reach into the margin of a grid of `size` texels.
int margin_needed(const GaussianBlur& blur, int size);

/// Both maps, of this size: three values a texel; the fourth is nothing.
void run_blur(const FaceGrid& masses, const GaussianBlur& blur, FaceGrid& first, FaceGrid& second,
              const Monitor& monitor);

}  // namespace welkin
