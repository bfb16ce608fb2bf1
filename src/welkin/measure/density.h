#pragma once

#include "welkin/base/export.h"
#include "welkin/sphere/registry.h"

/// @file
/// How evenly a parameterization spreads its texels.
namespace welkin {

/// How evenly a parameterization spreads its texels over the sphere. `minimum` … `maximum` are solid angles
/// of a texel over the average; an equal-area one has 1 and 1.
struct DensityReport {
  int width = 0;       ///< of a chart, texels
  int height = 0;      ///< of a chart, texels
  double average = 0;  ///< solid angle of a valid texel, sr: coverage / their number

  double minimum = 0;  ///< by the density at texel centres
  double maximum = 0;  ///< by the density at texel centres
  double ratio = 0;    ///< maximum / minimum

  /// At infinite resolution: the extremes of the density over the whole valid domain, edges included, over
  /// its average there. Within 1e-6 of the value, besides 1e-3 of the average's for domains that are neither
  /// full nor discs.
  double limit_minimum = 0;
  double limit_maximum = 0;  ///< as limit_minimum
  double limit_ratio = 0;    ///< infinite when unbounded
  bool unbounded = false;  ///< the density goes to zero (a pole) or to infinity somewhere: the ratio exceeds
                           ///< kUnboundedRatio
};
/// The ratio of densities beyond which it counts as unbounded: less than the 10⁴ at which
/// fisheye-orthographic caps its density at the rim.
inline constexpr double kUnboundedRatio = 5e3;

/// For charts of `size` texels across, 2 … 16384, and as high as makes texels square. Throws Error
/// (bad_request) outside.
WELKIN_API DensityReport density_of(const sphere::AnyParameterization& parameterization, int size);

/// The extremes of solid_angle_density over the valid domain, sr per unit (u, v) area, and that domain's
/// area, 1 for each full chart.
struct DensityLimits {
  double minimum;     ///< sr per unit area; 0 at a pole
  double maximum;     ///< sr per unit area; may be infinite
  double valid_area;  ///< of all charts together: 6 of a cube
};
/// The limits at infinite resolution, as in DensityReport.
WELKIN_API DensityLimits density_limits(const sphere::AnyParameterization& parameterization);

}  // namespace welkin
