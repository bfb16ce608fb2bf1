#pragma once

#include <vector>

#include "welkin/prefilter/fft.h"
#include "welkin/prefilter/legendre.h"
#include "welkin/prefilter/moments.h"
#include "welkin/prefilter/prefilter.h"
#include "welkin/prefilter/sampled_lobe.h"
#include "welkin/prefilter/widen.h"

/// What a plan keeps. Internal to prefilter.
namespace welkin {

/// A level that is computed by harmonics: coefficients times the lobe's, summed up on a lat-long grid, read
/// by spline.
struct HarmonicLevel {
  HarmonicLevel(const prefilter::WidenedLobe& lobe, int index, int moments_width);

  int index;  ///< of the level
  int degree;
  ChartSize grid;
  prefilter::FftPlan fft;
  prefilter::Latitudes latitudes;
  std::vector<float> zonal;  ///< λ_l
  std::vector<float> turn;   ///< cos, sin of the shift between the two grids' columns for each order, times
                             ///< the spline's factors
  lobe::AnyLobe lobe;
  std::vector<prefilter::SampledLobe> sampled;  ///< of a widened lobe; else none
  double scale;                                 ///< of a mass, so that the lobe's integral is 1
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
};

/// Fills the levels at `results` that harmonics make. Returns Moments::reduced.
std::optional<Map> run_harmonics(const PrefilterPlan::Tables& tables, const Map& source,
                                 std::vector<Map>& results, const Monitor& monitor);

}  // namespace welkin
