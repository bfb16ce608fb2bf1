#pragma once

#include <optional>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/base/monitor.h"
#include "welkin/light/light_set.h"
#include "welkin/map/map.h"

/// @file
/// Suns and lamps taken out of a map, so that they can cast shadows; what is left of the map, and how much.
namespace welkin {

/// Which lights are taken out.
struct ExtractOptions {
  int most = 16;  ///< at most so many, the strongest; at least 0
  /// A light's brightest texel has at least so many times the map's mean luminance; above 1, finite.
  double above = 10;
  /// Luminance of the strongest light's irradiance, above 0 and finite: what was measured beside a map whose
  /// sun is clipped. The light's irradiance is scaled to it, and keeps its colour; the residual doesn't
  /// change.
  std::optional<double> sun_irradiance = {};
  Monitor monitor = {};  ///< progress and cancelling
};

/// What extract_lights found, and what is left.
struct Extraction {
  LightSet found;  ///< the lights
  /// The map without the lights: as it was, and where they were filled smoothly from around. Nowhere above
  /// the map. Borders are filled.
  Map residual;
  double mean = 0;                      ///< luminance of the map over what it shows
  double shown = 0;                     ///< solid angle of what it shows, sr
  std::vector<double> energy;           ///< ∫ L dω of the map, for each of LightSet::channels
  std::vector<double> residual_energy;  ///< the same of the residual
};

/// Takes lights out of a map.
///
/// A light is a peak of luminance and the texels around it, across edges, poles and the date line: those of
/// at least `above` times the mean and a hundredth of its peak that are connected with it, and two texels
/// more all around, downhill, for an antialiased rim. Peaks between which luminance falls to half the lower
/// are two lights. What is above the surroundings, interpolated from the light's rim, is the light's; the
/// rest stays. So for every channel Σ irradiance (as the map has it: before ExtractedLight::restored) +
/// residual_energy = energy, to 1e-6; every texel whose centre is valid counts with texel_solid_angles. The
/// residual is nowhere negative where the map isn't. The same numbers whatever the number of threads.
///
/// Of a map that shows a part of the sphere, what it doesn't show counts for nothing, in the mean either, and
/// lights that its end cuts are marked. A black map, and an even one, has no lights.
///
/// Errors of an even disc of 0.53° and 10⁵ times the sky, in a lat-long of 1024×512: bench/light_speed.cpp,
/// docs/lights.md. Throws Error (bad_value) for values that aren't finite, (bad_request) for options out of
/// range; Cancelled.
WELKIN_API Extraction extract_lights(const Map& map, const ExtractOptions& options = {});

}  // namespace welkin
