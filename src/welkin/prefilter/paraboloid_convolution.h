#pragma once

#include "welkin/base/export.h"
#include "welkin/base/monitor.h"
#include "welkin/lobe/lobe.h"
#include "welkin/map/map.h"

/// @file
/// Pre-filtering as a convolution of dual paraboloid maps in the plane, an approximation of 2000, for what it
/// costs and how it errs (docs/prefiltering.md, "Paraboloid convolution"). PrefilterPlan is exact.
namespace welkin {

/// How filters are made of a lobe. The defaults are the text's.
struct ParaboloidConvolutionOptions {
  /// What weighs less than this part of the lobe's largest weight counts as 0: where the filter ends. Above
  /// 0, below 1.
  double clamp = 0.1;
  /// Texels that a filter has at most on a side. Where it needs more, the map is shrunk by halves first. 3 …
  /// 1024.
  int largest_filter = 7;
};

/// A filter: how large it is in a face's texels, and by which power of two faces are shrunk to apply it.
struct ParaboloidFilter {
  int diameter = 2;  ///< texels of the face, rounded up to an even number
  int shrink = 1;    ///< texels that become one, in each direction: level log2(shrink) of the mip pyramid
};

/// The two filters of a lobe.
struct ParaboloidFilters {
  ParaboloidFilter small;  ///< for the centre of a face
  ParaboloidFilter large;  ///< for its rim
  double angle = 0;        ///< at which the lobe has fallen to the clamp, radians, at most π/2
};

/// The filters of a lobe for faces of so many texels. With θ that angle and a face N texels wide, a cone of
/// radius θ about the centre is a disc of radius tan(θ/2) in a map whose rim has radius 1, so the small
/// filter is N·tan(θ/2) wide; seen from the rim, inwards, it ends 1 − tan(π/4 − θ/2) away, so the large one
/// is N times that. Shrunk by the least power of two that leaves at most `largest_filter` texels. Reproduces
/// the table of Kautz, Vázquez, Heidrich & Seidel 2000, §5. Throws Error (bad_request) for options out of
/// range, a face below 1.
WELKIN_API ParaboloidFilters paraboloid_filters(const lobe::AnyLobe& lobe, int face,
                                                const ParaboloidConvolutionOptions& options = {});

/// A paraboloid map filtered with a lobe, of charts of `size`. Each face, with a border that continues it
/// over the other half of the world, is shrunk and convolved with the small filter, giving S, and again with
/// the large one, giving L, both with weights of sum 1 that depend on the distance in the plane alone; at
/// distance d from a face's centre, rim 1, the result is (1 − d²)·S + d²·L. A mirror's lobe gives the map
/// resampled.
///
/// A constant map stays as it is; nothing else is exact. Solid angles of texels aren't counted, lobes end at
/// the clamp, the map is box-filtered, and a circle on a face is no circle about the same point of the sphere
/// (circle_distortion).
///
/// The same numbers whatever the number of threads. Throws Error: (mismatch) for maps that aren't paraboloid
/// maps with square faces, (bad_request) as paraboloid_filters does and for sizes that aren't square;
/// Cancelled. Source: Kautz, Vázquez, Heidrich & Seidel 2000, *A Unified Approach to Prefiltered Environment
/// Maps*, §5.
WELKIN_API Map convolve_paraboloid(const Map& source, const lobe::AnyLobe& lobe, ChartSize size,
                                   const ParaboloidConvolutionOptions& options = {},
                                   const Monitor& monitor = {});

/// How far a circle of radius r on a paraboloid map, its centre at distance d from the face's, rim 1, is from
/// a circle about the same centre on the sphere: (b − a)/(b + a), where a and b are the least and the largest
/// angle between the centre and the circle. (It is a circle there too, the map being stereographic: its
/// radius is (a + b)/2, and its centre lies (b − a)/2 away.) Kautz et al. 2000, fig. 12: up to 25 %, which is
/// the large filter of exponent 10, r = 0.51, at the rim. r > 0, d ≥ 0.
WELKIN_API double circle_distortion(double radius, double distance);

}  // namespace welkin
