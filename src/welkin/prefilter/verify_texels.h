#pragma once

#include <vector>

#include "welkin/prefilter/verify.h"

/// Which texels of a level are compared with the reference. Internal to prefilter.
namespace welkin::prefilter {

struct Texel {
  int chart = 0, x = 0, y = 0;
  friend auto operator<=>(const Texel&, const Texel&) = default;
};

/// `count` texels of the level, all of them where it has no more. Only texels whose centre is valid.
std::vector<Texel> random_texels(const Map& level, int count, std::uint64_t seed);

/// See VerifyOptions; `lights` are directions of the world. None twice.
std::vector<Texel> hot_texels(const Map& level, const std::vector<Vec3d>& lights,
                              const VerifyOptions& options);

/// World directions of the source's brightest texels, by luminance times solid angle, no two of them within
/// 3° of each other.
std::vector<Vec3d> brightest_lights(const Map& source, int count);

/// Centre of a texel, in the world.
Vec3d direction_of(const Map& map, const Texel& texel);

}  // namespace welkin::prefilter
