#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/base/monitor.h"
#include "welkin/light/light_set.h"
#include "welkin/map/map.h"

/// @file
/// A whole map as so many lights, for renderers that know no environment maps.
namespace welkin {

/// How the sphere is cut into regions, each of which becomes a light.
enum class RegionMethod {
  /// Of the regions the one with the most light is cut in two halves across its longer side (Debevec 2005),
  /// beside bright spots rather than through them: within 10 % of half, where it is darkest.
  median_cut,
  /// Of the regions the one whose light is spread the most is cut where what is left of the spread, ∫ L |d −
  /// centroid|² dω of the two, is smallest (Viriyothai & Debevec 2009, here in space, not in a picture).
  variance,
};

/// `median-cut`, `variance`.
WELKIN_API std::string_view name_of(RegionMethod method);

/// What region_lights makes.
struct RegionOptions {
  RegionMethod method = RegionMethod::variance;  ///< how the sphere is cut
  int count = 64;        ///< lights, 1 … 65536; fewer where light lies in fewer spots than that
  Monitor monitor = {};  ///< progress and cancelling
};

/// Lights that stand for all of a map: each for a region of the sphere, with its energy, from its centroid.
/// For every channel Σ irradiance = ∫ L dω of the map, to 1e-6; Σ solid_angle is that of the map, where no
/// region is black.
///
/// Regions are cut by planes through the sphere, so that none cares how the map is parameterized; edges and
/// poles are nowhere. What lies within half a degree isn't cut. Regions consist of texels; of maps of over a
/// million of these, of squares of texels. Negative luminance counts as 0 in cutting. The same numbers
/// whatever the number of threads.
///
/// Throws Error (bad_value) for values that aren't finite, (bad_request) for a count out of range; Cancelled.
WELKIN_API LightSet region_lights(const Map& map, const RegionOptions& options = {});

}  // namespace welkin
