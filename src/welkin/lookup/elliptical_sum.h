#pragma once

#include "welkin/lookup/cone_filters.h"
#include "welkin/lookup/elliptical_weights.h"
#include "welkin/lookup/tangent_plane.h"
#include "welkin/lookup/texel_blocks.h"

/// The elliptical weighted average of a level's texels. Internal to lookup.
namespace welkin {

/// exp(−½ pᵀ Σ⁻¹ p), p where a texel's centre lies in the plane of the logarithm map at a cone's direction,
/// times the texel's solid angle, for all texels within 4 σ, wherever on the map they lie.
class EllipticalSum {
 public:
  /// The level must outlive this.
  EllipticalSum(const sphere::AnyParameterization& p, const Level& level);

  /// Adds share × the mean to `mean`, channels values. False, and nothing is added, where no texel lies
  /// within 4 σ.
  bool add(const TangentPlane& plane, const Covariance& sigma, double share, double* mean) const;

 private:
  sphere::AnyParameterization p_;
  const Level* level_;
  TexelBlocks blocks_;
  WeighDirections weigh_;
  void (*add_row_)(const float* texel, const float* weights, const float* solid_angles, int count,
                   int channels, double* sum);
};

}  // namespace welkin
