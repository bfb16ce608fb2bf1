#pragma once

#include <vector>

#include "welkin/prefilter/fft.h"
#include "welkin/prefilter/near_field.h"
#include "welkin/prefilter/point_grid.h"
#include "welkin/prefilter/prefilter.h"
#include "welkin/prefilter/widen.h"

/// Near parts of narrow lobes (near_field.h), applied to maps. Internal to prefilter.
namespace welkin::prefilter {

/// The near part of a level, whose far part harmonics do.
struct NearLevel {
  /// `harmonic`: index of the far part in Tables::harmonic. `degree`: of the far part.
  NearLevel(const WidenedLobe& lobe, std::size_t harmonic, int rows, int degree, double tolerance,
            int points_width);

  std::size_t harmonic;
  NearField field;
  ChartSize grid;
  FftPlan fft;
  std::vector<float> phases;  ///< as HarmonicLevel's
};

/// Near parts that share a grid of weighted points.
struct NearGroup {
  NearGroup(const PrefilterShape& source, int rows, int last_order);

  PointGridPlan points;
  FftPlan fft;
  std::vector<float> factors;  ///< see order_factors
  std::vector<NearLevel> levels;
};

/// The near parts of `group`'s levels as spline grids, their borders filled, in the group's order. Throws
/// Cancelled.
std::vector<Level> run_near(const NearGroup& group, const Map& source, const Monitor& monitor);

}  // namespace welkin::prefilter
