#pragma once

#include <array>
#include <vector>

#include "welkin/light/light_set.h"
#include "welkin/map/texel_grid.h"

/// How large a light is, and of which shape. Internal to light.
namespace welkin {

/// A texel of a light.
struct LitTexel {
  TexelGrid::Index texel;
  double excess;       ///< luminance above the surroundings
  double solid_angle;  ///< sr
  Vec3d direction;     ///< of its centre, in the map's frame
};

/// A disc or ellipse, in the map's frame.
struct LightForm {
  Vec3d direction{0, 0, 1};
  LightShape shape = LightShape::point;
  double solid_angle = 0;
  std::array<double, 2> half_axes{0, 0};
  Vec3d axis{1, 0, 0};
};

/// The even disc or ellipse that makes the texels what they are. Where they are few, it is fitted to them by
/// least squares, each texel its mean; where they are many, it has their second moments, less a texel's own.
///
/// A disc much smaller than a texel makes the same texels as a somewhat larger one: then the form is a point,
/// and its solid angle that of the largest such disc.
LightForm find_form(const Map& map, const std::vector<LitTexel>& texels);

}  // namespace welkin
