#pragma once

#include "welkin/base/export.h"
#include "welkin/lobe/lobe.h"
#include "welkin/lookup/cone.h"
#include "welkin/map/map.h"

/// @file
/// Cones of what renderers have: pixels, rays and lobes.
///
/// A cone's σ are those of its second moments: Σ = (j_x j_xᵀ + j_y j_yᵀ)/12, where j_x and j_y are the sides
/// of a pixel in the plane of directions' logarithm map (angles from the middle). Against the true covariance
/// of the directions of a perspective camera's pixel: within 0.1 % for pixels of up to 5°, 2.1 % at 28°.
namespace welkin {

/// The cone that is alike all around: σ in radians.
WELKIN_API EllipticalCone isotropic_cone(const Vec3d& direction, double sigma);

/// The elliptical cone of a quadrilateral's second moments. One without area gives a cone without width
/// across it. Throws Error (bad_request) where fault_of finds a fault.
WELKIN_API EllipticalCone cone_of(const QuadCone& quad);

/// A ray and how it changes over one pixel, as renderers trace them (Igehy 1999): of a ray reflected, the
/// differentials of the reflected direction.
struct RayDifferential {
  Vec3d direction;  ///< of any length > 0
  Vec3d right;      ///< change of `direction` from a pixel to the next to its right
  Vec3d down;       ///< change of `direction` from a pixel to the one below
};

/// The cone of the pixel about a ray. Throws Error (bad_request): a direction that is zero, numbers that are
/// not finite.
WELKIN_API EllipticalCone cone_of(const RayDifferential& ray);

/// A rectangle of a picture: its middle and its size, in texels; texel centres lie at +½.
struct PictureArea {
  double x;           ///< to the right
  double y;           ///< down
  double width = 1;   ///< ≥ 0
  double height = 1;  ///< ≥ 0
};

/// What a pixel of a camera sees: the cone between the directions at the corners of an area of a picture,
/// in the world. Every parameterization is a camera (`fisheye-equidistant,fov=200`, `latlong`, a cube's
/// face); the picture is never read. Throws Error (bad_request): a chart that there isn't, an area whose
/// corners lie more than a chart's side outside it, or don't lie within a hemisphere.
WELKIN_API QuadCone cone_of_area(const MapFrame& picture, int chart, const PictureArea& area);

/// A cone seen by way of a rough surface: the lobe's variance is added on both axes, as when a Gaussian is
/// blurred by another. `lobe_sigma` ≥ 0, radians (lobe_sigma_of). Throws Error (bad_request) otherwise.
WELKIN_API EllipticalCone blurred(const EllipticalCone& cone, double lobe_sigma);

/// The σ of the Gaussian that keeps as much of a slow change of radiance as the lobe does: the mean cosine of
/// the lobe's directions is exp(−σ²). 0 for a mirror; at most kWidestSigma, for lobes whose mean cosine is 0
/// or less.
WELKIN_API double lobe_sigma_of(const lobe::AnyLobe& lobe);

/// Radians: a Gaussian of this σ is the mean over the sphere to 1e-6.
inline constexpr double kWidestSigma = 3.72;

}  // namespace welkin
