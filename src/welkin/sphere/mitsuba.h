#pragma once

#include "welkin/sphere/openexr.h"

namespace welkin::sphere {

/// The lat-long of Mitsuba 3's `envmap`: the centres of the first and last row lie on the poles, colatitude
/// π y/(H − 1) of row y, while columns are those of `latlong`. Source: Mitsuba 3, src/emitters/envmap.cpp,
/// eval_spectrum, which takes positions times (W, H − 1) and half a texel off those across.
struct MitsubaLatLong : EdgeCentred<LatLong, false> {
  static constexpr const char* kName = "mitsuba-latlong";
  static constexpr Traits kTraits{.projection = Projection::panorama, .follows_size = true};
};

}  // namespace welkin::sphere
