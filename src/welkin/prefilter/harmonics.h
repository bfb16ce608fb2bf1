#pragma once

#include <optional>
#include <vector>

#include "welkin/prefilter/fft.h"
#include "welkin/prefilter/legendre.h"
#include "welkin/prefilter/point_grid.h"
#include "welkin/prefilter/prefilter.h"
#include "welkin/prefilter/sampled_lobe.h"
#include "welkin/prefilter/widen.h"

/// Levels by spherical harmonics: analysis of the weighted points, coefficients times the lobe's, synthesis
/// on a lat-long grid that texels read by a spline. Internal to prefilter.
namespace welkin::prefilter {

/// Factors of the orders 0 … last of a grid's rows: the transform of a box where points are boxes, else 1.
std::vector<float> order_factors(const PointGridPlan& points, int last);

/// For each order 0 … last cos, sin of the phase between the first columns of two grids, `points_width` and
/// `grid_width` columns around; times the B-spline's transform along the row and the 6 of to_spline_columns.
std::vector<float> phases(int last, int grid_width, int points_width);

/// What all levels share: from weighted points to coefficients.
struct HarmonicAnalysis {
  HarmonicAnalysis(const PrefilterShape& source, int degree,
                   PointGridPlan::Rows use = PointGridPlan::Rows::locate_suns);

  int degree;
  PointGridPlan points;
  FftPlan fft;
  Latitudes latitudes;
  std::vector<float> factors;  ///< see order_factors
  std::vector<Recurrence> recurrences;
};

/// One level: from coefficients to a grid.
struct HarmonicLevel {
  /// `zonal`: of all of the lobe, or of its far part.
  HarmonicLevel(const WidenedLobe& lobe, const std::vector<double>& zonal, int index, int points_width);

  int index;  ///< of the level
  int degree;
  ChartSize grid;
  FftPlan fft;
  Latitudes latitudes;
  std::vector<float> zonal;   ///< λ_l
  std::vector<float> phases;  ///< see phases()
  lobe::AnyLobe lobe;
  bool all = false;  ///< harmonics of all points, the bright ones too: a far part, or a smooth lobe
  std::optional<SampledLobe> sampled;  ///< of a table, as a widened lobe is
  double scale;                        ///< of a weight, so that the lobe's integral is 1
};

struct BrightPoints;

/// From weighted points, `bright` ones apart, to the grids of the levels, before they are splines. `power`:
/// null, or filled with Σ |L_lm|² of each channel, of the points that aren't bright and degrees up to half of
/// the analysis's. The points are gone afterwards. Throws Cancelled.
std::vector<Level> synthesise_levels(const HarmonicAnalysis& analysis,
                                     const std::vector<HarmonicLevel>& levels, PointGrid& points,
                                     const BrightPoints& bright, std::vector<double>* power,
                                     const Monitor& monitor);

struct HarmonicResults {
  std::vector<Map> levels;  ///< in the order of Tables::harmonic, borders not filled
};

/// The levels of `tables.harmonic`, near parts included. Throws Cancelled, and Error for values that can't be
/// added up.
HarmonicResults run_harmonics(const PrefilterPlan::Tables& tables, const Map& source, const Monitor& monitor);

}  // namespace welkin::prefilter
