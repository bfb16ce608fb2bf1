#pragma once

#include <optional>
#include <vector>

#include "welkin/prefilter/harmonics.h"
#include "welkin/prefilter/near.h"
#include "welkin/prefilter/prefilter.h"

/// What a plan keeps. Internal to prefilter.
namespace welkin {

struct PrefilterPlan::Tables {
  PrefilterShape source;
  sphere::AnyParameterization target;
  std::vector<PrefilterLevel> levels;
  PrefilterOptions options;
  std::vector<PrefilterMethod> methods = {};

  std::optional<prefilter::HarmonicAnalysis> analysis = {};  ///< where there are `harmonic`
  std::vector<prefilter::HarmonicLevel> harmonic = {};       ///< in order of level
  std::vector<prefilter::NearGroup> near = {};

  /// Where a level's result goes: a map of its size, with the names of the source's channels. All of its
  /// texels are to be written, and its borders where the options ask for them.
  Map result(std::size_t level, const Map& map) const;
};

}  // namespace welkin
