#pragma once

#include <optional>
#include <span>
#include <vector>

#include "welkin/prefilter/harmonics.h"

/// Wide lobes from few harmonics, analysed on a coarse grid, where what they leave out is known to be little.
/// Internal to prefilter.
///
/// Of a map of power P_l at degree l the harmonics up to L leave out Σ_{l>L} λ_l² P_l of a level's mean
/// square: at most the square of the largest |λ_l| there times the map's whole power less what was analysed
/// of it, by Parseval's theorem. So a map says itself, while it is spread, whether few degrees suffice.
/// Bright texels are taken out of the grid first, and summed exactly.
namespace welkin::prefilter {

struct CoarsePlan {
  /// None where it wouldn't be faster, or where the source's rows don't fit: lat-longs only. `lobes`: those
  /// of `levels`.
  static std::optional<CoarsePlan> make(const PrefilterShape& source,
                                        const std::vector<HarmonicLevel>& levels,
                                        std::span<const WidenedLobe* const> lobes, double tolerance);

  /// A row of points, or two past a pole, that a row of the picture is spread to.
  struct Target {
    int row;
    bool opposite;  ///< the meridian
    float weight;
  };

  HarmonicAnalysis analysis;
  std::vector<HarmonicLevel> levels;         ///< as Tables::harmonic, of fewer degrees
  std::vector<double> beyond;                ///< of each: the largest |λ_l| past the degree
  std::vector<std::vector<Target>> targets;  ///< of each row of the picture
  std::vector<double> solid_angle;           ///< of a texel of each row
};

/// The levels of `tables.harmonic`, by its `coarse`; none where the bound isn't good enough for this map, or
/// it has values that can't be added up: they are to be made by run_harmonics. `negative` is set to whether
/// it has values below 0. Throws Cancelled.
std::optional<HarmonicResults> run_coarse(const PrefilterPlan::Tables& tables, const Map& source,
                                          bool& negative, const Monitor& monitor);

}  // namespace welkin::prefilter
