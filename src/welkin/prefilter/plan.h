#pragma once

#include <optional>
#include <vector>

#include "welkin/prefilter/coarse.h"
#include "welkin/prefilter/harmonics.h"
#include "welkin/prefilter/near.h"
#include "welkin/prefilter/prefilter.h"
#include "welkin/prefilter/sampled_group.h"

/// What a plan keeps. Internal to prefilter.
namespace welkin {

namespace prefilter {

/// Levels of one size whose lobes are tables: those of a stack of angles of view.
struct LevelGroup {
  std::vector<std::size_t> harmonic;  ///< indices into Tables::harmonic
  SampledGroup lobes;                 ///< theirs, in this order, with their scales
};

}  // namespace prefilter

struct PrefilterPlan::Tables {
  PrefilterShape source;
  sphere::AnyParameterization target;
  std::vector<PrefilterLevel> levels;
  PrefilterOptions options;
  std::vector<PrefilterMethod> methods = {};

  std::optional<prefilter::HarmonicAnalysis> analysis = {};  ///< where there are `harmonic`
  std::vector<prefilter::HarmonicLevel> harmonic = {};       ///< in order of level
  std::vector<prefilter::NearGroup> near = {};
  std::vector<prefilter::LevelGroup> groups = {};
  std::optional<prefilter::CoarsePlan> coarse = {};  ///< tried first

  /// Where a level's result goes: a map of its size, with the names of the source's channels. All of its
  /// texels are to be written, and its borders where the options ask for them.
  Map result(std::size_t level, const Map& map) const;
};

}  // namespace welkin
