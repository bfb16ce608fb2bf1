#pragma once

#include <memory>
#include <string>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/base/monitor.h"
#include "welkin/filter/filter.h"
#include "welkin/lobe/lobe.h"
#include "welkin/map/map.h"
#include "welkin/prefilter/source_faults.h"

/// @file
/// Pre-filtering: a map averaged with a lobe about every direction, so that lighting a material is one
/// look-up.
///
/// A level's texel in direction r holds ∫ w(1 − r·l) L(l) dω / ∫ w dω, where L is constant over the solid
/// angle of each of the source's texels (0 where the source shows nothing). docs/prefiltering.md has the
/// methods and their errors.
namespace welkin {

/// One result: a size and what its texels hold.
struct PrefilterLevel {
  ChartSize size;      ///< of each chart
  lobe::AnyLobe lobe;  ///< what it is filtered with
};

/// The maps that a plan is made for.
struct PrefilterShape {
  sphere::AnyParameterization parameterization;  ///< of the source
  ChartSize size;                                ///< of each chart
  int channels = 3;                              ///< all are filtered
};

/// What a level's values are.
enum class LobeScale {
  average,   ///< ∫ w L dω / ∫ w dω: a constant map stays as it is. What engines expect.
  integral,  ///< ∫ w L dω: of `lambert` the irradiance, of `phong` the sum of Heidrich & Seidel 1999. A
             ///< mirror's level is radiance and a channel A an average all the same.
};

/// How levels are made.
struct PrefilterOptions {
  /// Aim for the relative RMS error of every level, 1e-6 … 0.1. What is reached is measured, not guaranteed
  /// (docs/prefiltering.md).
  double tolerance = 1e-3;
  /// Of the results: Map::orientation.
  Matrix3 orientation = {};
  LobeScale scale = LobeScale::average;  ///< what values are
  /// How a mirror's level is resampled from the source (ResampleOptions::filter). `automatic` keeps the
  /// light.
  Filter mirror_filter = Filter::automatic;
  bool borders = true;  ///< false: leave the results' borders (fill_borders) to the caller
};

/// How a level is computed.
struct PrefilterMethod {
  std::string name;  ///< `resample`, `harmonics`, `near and far` (docs/prefiltering.md)
  int degree = 0;    ///< of the harmonics; wide lobes make do with fewer where the map allows it
  ChartSize grid;    ///< of directions at which they are synthesised, to be interpolated by a spline
  /// What the level is filtered with: the level's lobe, or where that is narrower than texels, a table of it
  /// convolved with a Gaussian (docs/prefiltering.md). The reference for the level is brute force with this
  /// one.
  lobe::AnyLobe lobe;
  double widened = 0;  ///< standard deviation of that Gaussian, radians; 0 where there is none
};

/// Everything that depends on sizes and lobes alone, kept for any number of maps: sequences and probe grids
/// pay for it once. Never changes; safe from many threads.
class WELKIN_API PrefilterPlan {
 public:
  /// Throws Error for sizes below 1, tolerances out of range, and levels whose tables would not fit in
  /// memory.
  PrefilterPlan(const PrefilterShape& source, const sphere::AnyParameterization& target,
                std::vector<PrefilterLevel> levels, const PrefilterOptions& options = {});

  /// The levels of a map of the plan's source shape (Error when it is another), which must have its borders
  /// filled; the results' are too, unless PrefilterOptions::borders says otherwise. Throws Error for values
  /// that aren't finite, or so large that their sum passes 1e34; Cancelled. Results are never negative where
  /// the source isn't. The same numbers whatever the number of threads.
  std::vector<Map> run(const Map& source, const Monitor& monitor = {}) const;
  /// The same, and what faults_of says of the source, found in passing where that is possible. It is set
  /// also where it is why Error is thrown; here any value beyond ±kMaxRadiance is a reason.
  std::vector<Map> run(const Map& source, SourceFaults& faults, const Monitor& monitor = {}) const;

  /// How each level is computed; valid as long as the plan or a copy of it.
  const std::vector<PrefilterMethod>& methods() const;

  struct Tables;

 private:
  std::vector<Map> run(const Map& source, SourceFaults* faults, const Monitor& monitor) const;

  std::shared_ptr<const Tables> tables_;
};

/// Plans and runs once. Throws as PrefilterPlan does.
WELKIN_API std::vector<Map> prefilter_map(const Map& source, const sphere::AnyParameterization& target,
                                          std::vector<PrefilterLevel> levels,
                                          const PrefilterOptions& options = {}, const Monitor& monitor = {});

}  // namespace welkin
