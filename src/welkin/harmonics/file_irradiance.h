#pragma once

#include <string_view>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/lobe/lobe.h"
#include "welkin/map/map.h"

/// @file
/// The diffuse light that files hold beside a cube: Babylon.js's `.env`, and the light of a `.glb`.
namespace welkin::harmonics {

/// For io::WriteOptions::irradiance: the map's harmonics to degree 2 in that basis, which is
/// io::Capabilities::irradiance of the file's format, 27 numbers, of R, G and B each; of a map of Y three
/// times the same. `look_up` takes the world to the coordinates by which the file's cube is looked up: the
/// orientation of the cube that is written. `lobe` is what the map is filtered with already, which is undone.
/// Throws Error (unsupported) for other channels, and as `basis_from_name` and `project` do.
WELKIN_API std::vector<double> file_irradiance(const Map& map, std::string_view basis, const Matrix3& look_up,
                                               const lobe::AnyLobe& lobe = lobe::AnyLobe::mirror());

}  // namespace welkin::harmonics
