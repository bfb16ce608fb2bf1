#pragma once

#include "welkin/base/export.h"
#include "welkin/sphere/registry.h"

namespace welkin {

/// How evenly a parameterization spreads its texels over the sphere. `minimum` … `maximum` are solid angles
/// of a texel over the average; an equal-area one has 1 and 1.
struct DensityReport {
  int width = 0, height = 0;  ///< of a chart, texels
  double average = 0;         ///< solid angle of a valid texel, sr: coverage / their number

  double minimum = 0, maximum = 0;  ///< by the density at texel centres
  double ratio = 0;                 ///< maximum / minimum

  /// At infinite resolution: the extremes of the density over the whole valid domain, edges included, over
  /// its average there. Within 1e-6 of the value, besides 1e-3 of the average's for domains that are neither
  /// full nor discs.
  double limit_minimum = 0, limit_maximum = 0;
  double limit_ratio = 0;  ///< infinite when unbounded
  bool unbounded = false;  ///< the density goes to zero (a pole) or to infinity somewhere: the ratio exceeds
                           ///< kUnboundedRatio
};
/// Less than the 10⁴ at which fisheye-orthographic caps its density at the rim.
inline constexpr double kUnboundedRatio = 5e3;

/// For charts of `size` texels across, 2 … 16384, and as high as makes texels square. Throws Error outside.
WELKIN_API DensityReport density_of(const sphere::AnyParameterization& parameterization, int size);

/// The extremes of solid_angle_density over the valid domain, sr per unit (u, v) area, and that domain's
/// area, 1 for a full chart.
struct DensityLimits {
  double minimum, maximum, valid_area;
};
WELKIN_API DensityLimits density_limits(const sphere::AnyParameterization& parameterization);

}  // namespace welkin
