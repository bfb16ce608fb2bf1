#pragma once

#include <vector>

#include "welkin/base/export.h"
#include "welkin/lobe/lobe.h"
#include "welkin/map/map.h"

/// @file
/// The diffuse light of Babylon.js's environments.
namespace welkin::harmonics {

/// What a `.env` holds of its diffuse light, for io::WriteOptions::irradiance: the map's harmonics to degree
/// 2 in the basis `babylon`, 27 numbers, of R, G and B each; of a map of Y three times the same. `look_up`
/// takes the world to the coordinates by which Babylon.js looks the file's cube up: the orientation of the
/// cube that is written. `lobe` is what the map is filtered with already, which is undone. Throws Error
/// (unsupported) for other channels, and as `project` does.
WELKIN_API std::vector<double> env_irradiance(const Map& map, const Matrix3& look_up,
                                              const lobe::AnyLobe& lobe = lobe::AnyLobe::mirror());

}  // namespace welkin::harmonics
