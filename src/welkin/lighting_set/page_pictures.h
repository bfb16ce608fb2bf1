#pragma once

#include <string>

#include "welkin/base/monitor.h"
#include "welkin/map/map.h"

/// Pictures of maps for a page, as `data:` URLs of sRGB files. Internal to lighting_set.
namespace welkin::lighting_set {

/// All take the factor that radiance is multiplied by before it is clipped.
struct PagePictures {
  double exposure = 1;
  Monitor monitor = {};

  /// The ball of that many texels across that reflects a map, as a photograph shows it.
  std::string mirror_ball(const Map& map, int width) const;
  /// The ball whose every pixel looks a map up along its normal.
  std::string normal_ball(const Map& map, int width) const;
  /// A lat-long, as JPEG.
  std::string panorama(const Map& map) const;
  /// A cube's faces as a horizontal cross, texel by texel.
  std::string cross(const Map& map) const;
};

}  // namespace welkin::lighting_set
