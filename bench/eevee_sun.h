#pragma once

#include "welkin/map/map.h"

/// The sun that Blender's EEVEE takes out of a world, by its formulas (Blender pull request 121455, its
/// shader eevee_lightprobe_sphere): here on a map's own texels, in double. For comparison.
namespace welkin::bench {

struct EeveeSun {
  Vec3d direction{0, 0, 1};  ///< mean direction of all excess, however many suns it comes from
  double irradiance = 0;     ///< Σ excess · Ω of channel 0
  double solid_angle = 0;    ///< of a cap about it: cos θ = 2ℓ − 1, ℓ the mean direction's length
};

/// `threshold` is a radiance: what a texel's brightest channel has above it is the sun's.
EeveeSun eevee_sun(const Map& map, double threshold);

}  // namespace welkin::bench
