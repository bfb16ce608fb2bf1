#pragma once

#include <vector>

#include "welkin/prefilter/fft.h"
#include "welkin/prefilter/legendre.h"
#include "welkin/prefilter/moments.h"
#include "welkin/prefilter/near_field.h"
#include "welkin/prefilter/prefilter.h"
#include "welkin/prefilter/sampled_lobe.h"
#include "welkin/prefilter/widen.h"

/// What a plan keeps. Internal to prefilter.
namespace welkin {

/// A level that is computed by harmonics: coefficients times the lobe's, summed up on a lat-long grid, read
/// by spline.
struct HarmonicLevel {
  /// `zonal`: of all of the lobe, or of its far part.
  HarmonicLevel(const prefilter::WidenedLobe& lobe, const std::vector<double>& zonal, int index,
                int moments_width);

  int index;  ///< of the level
  int degree;
  ChartSize grid;
  prefilter::FftPlan fft;
  prefilter::Latitudes latitudes;
  std::vector<float> zonal;  ///< λ_l
  std::vector<float> turn;   ///< cos, sin of the shift between the two grids' columns for each order, times
                             ///< the spline's factors
  lobe::AnyLobe lobe;
  bool all = false;  ///< harmonics of all masses, the bright ones too: a far part, or a smooth lobe
  std::vector<prefilter::SampledLobe> sampled;  ///< of a widened lobe; else none
  double scale;                                 ///< of a mass, so that the lobe's integral is 1
};

/// The near part of a level, whose far part harmonics do.
struct NearLevel {
  NearLevel(const prefilter::WidenedLobe& lobe, std::size_t harmonic, int rows, int degree, double tolerance,
            int moments_width);

  std::size_t harmonic;  ///< index of the far part in Tables::harmonic
  prefilter::NearField field;
  ChartSize grid;
  prefilter::FftPlan fft;
  std::vector<float> turn;  ///< as HarmonicLevel's
};

/// Near parts that share a grid of masses.
struct NearGroup {
  NearGroup(const PrefilterShape& source, int rows, int last_order);

  prefilter::MomentPlan moments;
  prefilter::FftPlan fft;
  std::vector<float> factors;
  std::vector<NearLevel> levels;
};

struct PrefilterPlan::Tables {
  PrefilterShape source;
  sphere::AnyParameterization target;
  std::vector<PrefilterLevel> levels;
  PrefilterOptions options;
  std::vector<PrefilterMethod> methods = {};

  std::vector<HarmonicLevel> harmonic = {};         ///< in order of level
  int degree = 0;                                   ///< largest of them
  std::vector<prefilter::MomentPlan> moments = {};  ///< none or one, as are moments_fft and moments_latitudes
  std::vector<float> order_factors = {};            ///< of the orders of the masses' rows
  std::vector<prefilter::FftPlan> moments_fft = {};
  std::vector<prefilter::Latitudes> moments_latitudes = {};
  std::vector<prefilter::Recurrence> recurrences = {};
  std::vector<NearGroup> near = {};
};

/// Fills the levels at `results` that harmonics make. Returns Moments::reduced.
std::optional<Map> run_harmonics(const PrefilterPlan::Tables& tables, const Map& source,
                                 std::vector<Map>& results, const Monitor& monitor);

/// The near parts of `group`'s levels as spline grids, their borders filled, in the group's order.
std::vector<Level> run_near(const NearGroup& group, const Map& source, const Monitor& monitor);

}  // namespace welkin
