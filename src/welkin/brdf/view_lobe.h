#pragma once

#include <vector>

#include "welkin/base/export.h"
#include "welkin/brdf/brdf.h"
#include "welkin/lobe/lobe.h"

/// @file
/// What a surface seen from one direction reflects, as a lobe of directions of light, and that lobe made
/// rotationally symmetric, so that maps can be pre-filtered with it.
///
/// A *tilt* turns a direction in the plane of incidence, the one through the normal and the viewer, from the
/// reflected direction r towards the normal n, radians; r's elevation above the surface, asin(n·v), plus the
/// tilt is the elevation of what is turned. 0 is r, π/2 − asin(n·v) the normal, π − 2 asin(n·v) the viewer.
namespace welkin::brdf {

/// Which axis a lobe is averaged about.
enum class LobeAxis {
  reflected,  ///< r = 2 (n·v) n − v, as Kautz & McCool 2000 have it
  fitted,     ///< in the plane of incidence, where the averaged lobe is closest to the lobe
              ///< (docs/view-dependent-lobes.md)
};

/// A lobe made rotationally symmetric.
struct AveragedLobe {
  /// The mean of BRDF · cosine over each circle about the axis; 0 below the surface, which is part of the
  /// mean.
  lobe::AnyLobe lobe;
  double tilt = 0;  ///< of the axis
  /// ∫ BRDF (n·l) dω: the share of light from all around that is reflected. A constant radiance times this is
  /// what is seen.
  double albedo = 0;
};

/// Light weighted by BRDF · cosine: Σ weights[i] L(directions[i]) = ∫ BRDF (n·l) L(l) dω for L that is smooth
/// at the scale of the points. In the surface's frame: the normal at +z, the viewer at x > 0, y = 0.
struct LobePoints {
  std::vector<Vec3d> directions;  ///< unit length; every second of a pair at −y is there too
  std::vector<double> weights;    ///< not negative
};

/// Gauss–Legendre on panels in the coordinates of the plane of incidence (elevation in it, angle from it),
/// which shrink towards the plane, r and the viewer by halves to the BRDF's width. `nodes` of a panel, 2 …
/// 16, in each direction: with 6, ∫ of `ggx` is good to 5e-6. Throws Error (bad_request) for a mirror, n·v
/// outside 0 … 1 or 0, and (bad_value) for a BRDF that isn't finite or is negative there.
WELKIN_API LobePoints lobe_points(const AnyBrdf& brdf, double view_cosine, int nodes = 6);

/// ∫ BRDF (n·l) dω at n·v: the directional albedo. Throws as lobe_points does.
WELKIN_API double directional_albedo(const AnyBrdf& brdf, double view_cosine);

/// The tilt at which the lobe's average about the axis keeps most of it: the axis of LobeAxis::fitted. Throws
/// as lobe_points does.
WELKIN_API double fitted_tilt(const AnyBrdf& brdf, double view_cosine);

/// The lobe at n·v averaged about the axis of this tilt. Values between the table's angles are off by at most
/// about 1e-4 of the lobe in all. Throws as lobe_points does, and Error (bad_value) for a surface that
/// reflects nothing.
WELKIN_API AveragedLobe average_lobe(const AnyBrdf& brdf, double view_cosine, double tilt);
/// The same about a chosen axis.
WELKIN_API AveragedLobe average_lobe(const AnyBrdf& brdf, double view_cosine, LobeAxis axis);

/// The direction of this tilt in the surface's frame of lobe_points.
WELKIN_API Vec3d tilted_direction(double view_cosine, double tilt);

}  // namespace welkin::brdf
