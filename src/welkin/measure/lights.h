#pragma once

#include <vector>

#include "welkin/measure/energy.h"

/// The brightest lights of a map. Internal to measure.
namespace welkin {

/// At most `count` lights (energy.h), the brightest first. `maxima` are the largest values of each row's
/// segments (EnergyFrame::whole), `mean` is the map's luminance: only segments that stand out are read.
std::vector<Light> find_lights(const Map& map, const std::vector<float>& maxima, double mean, int count,
                               const Monitor& monitor);

}  // namespace welkin
