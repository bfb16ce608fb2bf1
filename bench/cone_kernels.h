#pragma once

#include <functional>
#include <vector>

#include "welkin/lookup/cone.h"
#include "welkin/map/map.h"

/// What each filter of cones means to compute, in float64.
namespace welkin::bench {

/// A filter's own mean over a cone, a value for each channel.
using OwnMean = std::function<std::vector<double>(const Map&, const EllipticalCone&)>;

/// trilinear: the circle of the same area.
std::vector<double> own_trilinear(const Map& map, const EllipticalCone& cone);
/// differential, mirrored: a texel of the level is √12·wide, and trilinear interpolation has half of that as
/// σ.
std::vector<double> own_longer_side(const Map& map, const EllipticalCone& cone);
/// box: the square of texels as large as the pixel.
std::vector<double> own_box(const Map& map, const EllipticalCone& cone);
/// sat: rectangles of texels.
OwnMean own_boxes(int count);
/// probes: a row of circles, at most 16.
std::vector<double> own_probes(const Map& map, const EllipticalCone& cone);
/// ewa, hybrid: the Gaussian of the logarithm map.
std::vector<double> own_ewa(const Map& map, const EllipticalCone& cone);
/// gaussian: the cone itself.
std::vector<double> own_cone(const Map& map, const EllipticalCone& cone);

}  // namespace welkin::bench
