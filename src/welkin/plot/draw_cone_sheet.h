#pragma once

#include <vector>

#include "welkin/base/export.h"
#include "welkin/lookup/cone_sampler.h"
#include "welkin/map/map.h"

/// @file
/// Pictures of how filters average over cones.
namespace welkin {

/// The filters that can be used on maps of a parameterization.
WELKIN_API std::vector<ConeFilter> usable_cone_filters(const sphere::AnyParameterization& parameterization);

/// What a sheet of look-ups shows.
struct ConeSheet {
  std::vector<ConeFilter> filters = {};  ///< a tile each; empty: all that can be used on the map
  std::string camera = "mirror-ball";    ///< the parameterization that each tile is a picture of
  int size = 160;                        ///< pixels along a tile's longer side, 16 … 2048
  double exposure = 0;                   ///< stops by which tiles are brightened
};

/// The map as a camera sees it, every pixel looked up over its cone, by one filter after the other; the first
/// tile is the mean of 256 rays a pixel. A mirror ball has all that is hard for filters: cones that grow
/// longer toward its rim, up to the whole world, and every pole, fold and corner of the map. RGB, linear,
/// four tiles in a row, their numbers below: 0 is that of the rays. Throws Error (bad_request): a camera that
/// there isn't, or of several charts, sizes out of range; and as ConeSampler does.
WELKIN_API Image draw_cone_sheet(const Map& map, const ConeSheet& sheet = {});

}  // namespace welkin
