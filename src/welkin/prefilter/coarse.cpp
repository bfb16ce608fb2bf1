#include "welkin/prefilter/coarse.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "welkin/base/parallel.h"
#include "welkin/lobe/zonal.h"
#include "welkin/math/gauss_legendre.h"
#include "welkin/prefilter/bright_points.h"
#include "welkin/prefilter/level_texels.h"
#include "welkin/prefilter/plan.h"
#include "welkin/prefilter/source_faults.h"
#include "welkin/prefilter/spline_grid.h"

namespace welkin::prefilter {
namespace {

using Tables = PrefilterPlan::Tables;

/// λ_l may be this part of the tolerance past the degree: maps then mostly stay far below the bound.
constexpr double kBeyond = 1.0 / 40;
/// What the bound may be of a level's mean: the part of the tolerance that truncation has elsewhere.
constexpr double kOfMean = 1.0 / 5;
/// In a texel the error is mostly below this many times its RMS, and may be this many tolerances of the
/// texel.
constexpr double kOfTexel = 5, kDeviations = 4;
/// Rounding of float32 sums, relative to all of the light.
constexpr double kRounding = 1e-7;

struct BrightTexel {
  float size;
  int y, x;
  friend bool operator<(const BrightTexel& a, const BrightTexel& b) {
    return std::tie(b.size, a.y, a.x) < std::tie(a.size, b.y, b.x);
  }
};

/// The largest texels of weight over `threshold`, `most` at most.
std::vector<BrightTexel> find_bright(const CoarsePlan& plan, const Map& source,
                                     const std::vector<RowValues>& values, double threshold,
                                     std::size_t most) {
  std::vector<BrightTexel> all;
  for (int y = 0; y < source.height(); ++y) {
    const RowValues& row = values[static_cast<std::size_t>(y)];
    const double omega = plan.solid_angle[static_cast<std::size_t>(y)];
    if (static_cast<double>(std::max(row.largest, -row.smallest)) * omega <= threshold) continue;
    const float* texels = source.level.chart(0).row(y);
    const float limit = static_cast<float>(threshold / omega);
    const int step = 16 * source.channels(), count = source.width() * source.channels();
    for (int from = 0; from < count; from += step) {
      const int to = std::min(count, from + step);
      int found = 0;
      for (int i = from; i < to; ++i) found |= std::fabs(texels[i]) > limit ? 1 : 0;
      if (found == 0) continue;
      for (int i = from; i < to; i += source.channels()) {
        float size = 0;
        for (int c = 0; c < source.channels(); ++c) size = std::max(size, std::fabs(texels[i + c]));
        if (size > limit) all.push_back({size * static_cast<float>(omega), y, i / source.channels()});
      }
    }
  }
  const auto end = all.begin() + static_cast<std::ptrdiff_t>(std::min(most, all.size()));
  std::partial_sort(all.begin(), end, all.end());
  all.erase(end, all.end());
  return all;
}

/// Takes from the points what was spread of a texel.
void take_texel(const CoarsePlan& plan, const Map& source, const BrightTexel& texel, PointGrid& points) {
  const ColumnSpread& along = *plan.analysis.points.columns;
  const int taps = static_cast<int>(along.along.size()), width = source.width();
  const float* value = source.level.chart(0).at(texel.x, texel.y);
  for (const CoarsePlan::Target& target : plan.targets[static_cast<std::size_t>(texel.y)]) {
    const bool south = target.row >= points.height / 2;
    const int north = south ? points.height - 1 - target.row : target.row;
    const int x = (texel.x + (target.opposite ? width / 2 : 0)) % width;
    // Columns whose taps reach x: x + reach − columns·k is a tap.
    const int last = (x + along.reach) / along.columns;
    for (int k = last; x + along.reach - along.columns * k < taps; --k) {
      const float weight =
          target.weight * along.along[static_cast<std::size_t>(x + along.reach - along.columns * k)];
      const int column = (k % points.width + points.width) % points.width;
      for (int c = 0; c < points.channels; ++c) {
        points.at(north / 8, c)[column * 16 + (south ? 8 : 0) + north % 8] -= weight * value[c];
      }
    }
  }
}

/// A texel as points: Gauss's rule of three each way where it holds much of the light, for directions that
/// have it on their horizon; its middle otherwise.
void append_points(const CoarsePlan& plan, const Map& source, const BrightTexel& texel, bool much,
                   BrightPoints& bright) {
  const QuadratureRule rule = gauss_legendre(much ? 3 : 1);
  const float omega = static_cast<float>(plan.solid_angle[static_cast<std::size_t>(texel.y)]);
  const float* value = source.level.chart(0).at(texel.x, texel.y);
  for (std::size_t j = 0; j < rule.nodes.size(); ++j) {
    const double theta = (texel.y + 0.5 + rule.nodes[j] / 2) * kPi / source.height();
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      const double longitude = 2 * kPi * (0.5 - (texel.x + 0.5 + rule.nodes[i] / 2) / source.width());
      bright.x.push_back(static_cast<float>(std::sin(theta) * std::sin(longitude)));
      bright.y.push_back(static_cast<float>(std::cos(theta)));
      bright.z.push_back(static_cast<float>(std::sin(theta) * std::cos(longitude)));
      const float share = static_cast<float>(rule.weights[i] * rule.weights[j] / 4);
      for (int c = 0; c < bright.channels; ++c) bright.weight.push_back(share * omega * value[c]);
    }
  }
}

/// `light`: of all channels.
BrightPoints take_bright(const CoarsePlan& plan, const Map& source, const std::vector<BrightTexel>& texels,
                         double light, PointGrid& points) {
  constexpr double kMuch = 1e-3;
  BrightPoints bright;
  bright.channels = points.channels;
  for (const BrightTexel& texel : texels) {
    take_texel(plan, source, texel, points);
    append_points(plan, source, texel, static_cast<double>(texel.size) > kMuch * light, bright);
  }
  return bright;
}

/// Of each channel: the sum of weights, and ∫ L².
struct Totals {
  std::vector<double> light, square;
};

Totals totals_of(const CoarsePlan& plan, const std::vector<RowValues>& values, const PointGrid& points) {
  const std::size_t channels = static_cast<std::size_t>(points.channels);
  Totals totals{std::vector<double>(channels), std::vector<double>(channels)};
  for (std::size_t c = 0; c < channels; ++c) {
    for (std::size_t y = 0; y < values.size(); ++y)
      totals.square[c] += plan.solid_angle[y] * values[y].squares[c];
    for (int pack = 0; pack < points.packs; ++pack) {
      const float* weights = points.at(pack, static_cast<int>(c));
      float sums[16] = {};
      for (int i = 0; i < points.width * 16; i += 16) {
        for (int lane = 0; lane < 16; ++lane) sums[lane] += weights[i + lane];
      }
      for (const float sum : sums) totals.light[c] += static_cast<double>(sum);
    }
  }
  return totals;
}

bool can_be_added(const std::vector<RowValues>& values, const Totals& totals) {
  const bool in_range = std::all_of(values.begin(), values.end(), [](const RowValues& row) {
    return std::max(row.largest, -row.smallest) <= kMaxRadiance;
  });
  return in_range && std::all_of(totals.square.begin(), totals.square.end(),
                                 [](double square) { return std::isfinite(square); });
}

/// Whether an error of RMS `deviation`, all channels together, shows in no texel.
bool is_small_in_all(const Map& level, double deviation, double tolerance) {
  const double least = kDeviations * deviation / (kOfTexel * tolerance);
  const sphere::AnyParameterization& p = level.parameterization;
  const bool whole = p.full_charts();
  for (int chart = 0; chart < level.charts(); ++chart) {
    for (int y = 0; y < level.height(); ++y) {
      const float* texel = level.level.chart(chart).row(y);
      for (int x = 0; x < level.width(); ++x, texel += level.channels()) {
        if (!whole && !p.valid(chart, (x + 0.5) / level.width(), (y + 0.5) / level.height())) continue;
        double square = 0;
        for (int c = 0; c < level.channels(); ++c)
          square += static_cast<double>(texel[c]) * static_cast<double>(texel[c]);
        if (!(square >= least * least)) return false;
      }
    }
  }
  return true;
}

}  // namespace

std::optional<CoarsePlan> CoarsePlan::make(const PrefilterShape& source,
                                           const std::vector<HarmonicLevel>& levels,
                                           std::span<const WidenedLobe* const> lobes, double tolerance) {
  if (levels.empty() || source.channels > RowValues::kMostChannels ||
      !source.parameterization.traits().latlong_grid)
    return std::nullopt;
  int degree = 8;
  for (const WidenedLobe* each : lobes) {
    degree = std::max(degree, lobe::degree_for(each->lobe, kBeyond * tolerance, kCheapDegree + 1));
    if (degree > kCheapDegree) return std::nullopt;
  }
  CoarsePlan plan{{source, degree, PointGridPlan::Rows::few}, {}, {}, {}, {}};
  const PointGridPlan& points = plan.analysis.points;
  if (points.way != PointGridPlan::Way::spread_points || points.columns->columns < 2 ||
      2 * points.height > source.size.height || source.size.height % points.height != 0)
    return std::nullopt;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    std::vector<double> all = lobe::zonal_coefficients(lobes[i]->lobe, 4 * kCheapDegree);
    plan.beyond.push_back(lobe::zonal_tail(all).largest[static_cast<std::size_t>(degree)]);
    all.resize(static_cast<std::size_t>(degree) + 1);
    HarmonicLevel& level = plan.levels.emplace_back(*lobes[i], all, levels[i].index, points.width);
    level.sampled = levels[i].sampled;
  }
  plan.targets.resize(static_cast<std::size_t>(source.size.height));
  for (int row = 0; row < points.rows->rows(); ++row) {
    for (int k = points.rows->first[static_cast<std::size_t>(row)];
         k < points.rows->first[static_cast<std::size_t>(row) + 1]; ++k) {
      const RowSpread::Tap& tap = points.rows->taps[static_cast<std::size_t>(k)];
      plan.targets[static_cast<std::size_t>(tap.row)].push_back({row, tap.opposite, tap.weight});
    }
  }
  for (int y = 0; y < source.size.height; ++y) {
    const double step = kPi / source.size.height;
    plan.solid_angle.push_back((std::cos(y * step) - std::cos((y + 1) * step)) * 2 * kPi / source.size.width);
  }
  return plan;
}

std::optional<HarmonicResults> run_coarse(const Tables& t, const Map& source, bool& negative,
                                          const Monitor& monitor) {
  const CoarsePlan& plan = *t.coarse;
  std::vector<RowValues> values(static_cast<std::size_t>(source.height()));
  PointGrid points = make_point_grid(source, plan.analysis.points, values, part_of(monitor, 0, 0.5));
  const Totals totals = totals_of(plan, values, points);
  if (!can_be_added(values, totals)) return std::nullopt;

  negative = std::any_of(values.begin(), values.end(), [](const RowValues& row) { return row.smallest < 0; });

  const std::size_t channels = static_cast<std::size_t>(source.channels());
  double light = 0;
  for (const double each : totals.light) light += std::fabs(each);
  const BrightRule rule;
  const double texels = static_cast<double>(source.width()) * source.height();
  const double finer = std::max(1.0, source.height() / 512.0);
  const std::vector<BrightTexel> bright_texels =
      find_bright(plan, source, values, rule.contrast * light / (texels * static_cast<double>(channels)),
                  static_cast<std::size_t>(std::min(rule.always * finer * finer, 1024.0)));
  const BrightPoints bright = take_bright(plan, source, bright_texels, light, points);

  std::vector<double> power;
  std::vector<Level> grids =
      synthesise_levels(plan.analysis, plan.levels, points, bright, &power, part_of(monitor, 0.5, 0.8));

  // The RMS of what was not analysed.
  double rest = 0;
  for (std::size_t c = 0; c < channels; ++c) {
    double square = totals.square[c];
    for (const BrightTexel& texel : bright_texels) {
      const double value = static_cast<double>(source.level.chart(0).at(texel.x, texel.y)[c]);
      square -= value * value * plan.solid_angle[static_cast<std::size_t>(texel.y)];
    }
    // What rounding leaves of the analysed power and of the bright texels'.
    const double least = std::max(1e-3 * square, 10 * kRounding * totals.square[c]);
    const double left = std::max(square - power[c], least) / (4 * kPi);
    const double mean = std::fabs(totals.light[c]) / (4 * kPi);
    for (const double beyond : plan.beyond) {
      if (beyond * std::sqrt(left) > kOfMean * t.options.tolerance * mean) return std::nullopt;
    }
    rest += left;
  }

  to_splines(grids, without_progress(monitor));
  const std::vector<const Level*> near(grids.size(), nullptr);
  HarmonicResults results{
      make_level_texels(t, plan.levels, grids, near, bright, source, part_of(monitor, 0.8, 1))};
  for (std::size_t i = 0; i < results.levels.size(); ++i) {
    const double deviation = plan.beyond[i] * std::sqrt(rest) + kRounding * light / kPi;
    if (!is_small_in_all(results.levels[i], deviation, t.options.tolerance)) return std::nullopt;
  }
  return results;
}

}  // namespace welkin::prefilter
