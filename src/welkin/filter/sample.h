#pragma once

#include <span>

#include "welkin/filter/resample.h"

namespace welkin {

/// Looks a level up along directions of the world: out[i·channels…] for each of `directions`, which may have
/// any length > 0. `automatic` reads as bicubic does, there being no texel to average over. Where the map
/// shows nothing, 0. `level` is of the map (Map::level, or one of its pyramid), its borders filled.
void sample(const Map& map, const Level& level, std::span<const Vec3d> directions, Filter filter,
            std::span<float> out);

}  // namespace welkin
