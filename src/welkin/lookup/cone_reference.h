#pragma once

#include <functional>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/lookup/cone.h"
#include "welkin/map/map.h"

/// @file
/// Look-ups over cones by brute force in float64, to measure against.
namespace welkin {

/// κ of the von Mises–Fisher distribution exp(κ cos θ) whose mean cosine is exp(−σ²), as that of the heat
/// kernel of variance σ² along each tangent is: κ ≈ 1/σ² + ½ where σ is small, and 0, uniform, where it is
/// large. `sigma` > 0, radians.
WELKIN_API double vmf_concentration(double sigma);

/// The weight of a direction in an elliptical cone, sr⁻¹: the von Mises–Fisher distribution of `narrow` (by
/// vmf_concentration) spread along the great circle through `direction` and `axis` by a wrapped Gaussian of
/// variance wide² − narrow². Its integral over the sphere is 1. The spreading is a sum of Gaussian steps of
/// half of `narrow` along the circle, whose error is below 1e-12.
class WELKIN_API ConeWeight {
 public:
  /// Throws Error (bad_request) where fault_of finds a fault, and for a cone whose `narrow` is 0.
  explicit ConeWeight(const EllipticalCone& cone);

  /// At a direction of unit length.
  double operator()(const Vec3d& direction) const;
  /// Farther than this from the cone's direction, radians, there is less than 1e-17 of it.
  double reach() const { return reach_; }

 private:
  struct Step {
    Vec3d direction;
    double share;
  };
  double concentration_, scale_, reach_;
  Vec3d pole_;  ///< of the great circle
  std::vector<Step> steps_;
};

/// The mean of a map over a weight on the sphere, which takes unit directions of the world: every texel is
/// one value over its whole area, in which points × points points of a regular grid are weighted. Tends to
/// the exact mean as `points` ≥ 1 grows: there should be two points and more within a cone's `narrow`. Of a
/// map that doesn't show the whole world, the mean over what it shows; 0 where all that weighs nothing. A
/// value for each channel. On all processors; its result does not depend on how many there are.
WELKIN_API std::vector<double> weighted_mean(const Map& map,
                                             const std::function<double(const Vec3d&)>& weight, int points);

/// The mean over an elliptical cone, by ConeWeight.
WELKIN_API std::vector<double> look_up_reference(const Map& map, const EllipticalCone& cone, int points);

/// The mean over the part of the sphere within a quadrilateral of great circles, all of it alike. Its error
/// falls as 1/points. Corners in any order that doesn't cross itself; of one that does, the parts inside by
/// the even-odd rule. Throws Error (bad_request) where fault_of finds a fault, and when no point lies inside:
/// a quadrilateral without area, or too small for `points`.
WELKIN_API std::vector<double> look_up_reference(const Map& map, const QuadCone& cone, int points);

}  // namespace welkin
