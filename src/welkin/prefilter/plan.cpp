#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>

#include "welkin/base/error.h"
#include "welkin/base/number_text.h"
#include "welkin/base/parallel.h"
#include "welkin/filter/resample.h"
#include "welkin/lobe/energy.h"
#include "welkin/map/adjust.h"
#include "welkin/map/texel_points.h"
#include "welkin/prefilter/source_faults.h"
#include "welkin/prefilter/spline_grid.h"
#include "welkin/prefilter/tables.h"
#include "welkin/prefilter/widen.h"

namespace welkin {
namespace {

using namespace prefilter;

void check(const PrefilterShape& source, const std::vector<PrefilterLevel>& levels,
           const PrefilterOptions& options) {
  const auto positive = [](ChartSize size) { return size.width > 0 && size.height > 0; };
  if (!positive(source.size) || source.channels < 1)
    throw Error(ErrorKind::bad_request, "prefilter: the source has no texels");
  for (const PrefilterLevel& level : levels) {
    if (!positive(level.size)) throw Error(ErrorKind::bad_request, "prefilter: a level has no texels");
  }
  if (!(options.tolerance >= 1e-6 && options.tolerance <= 0.1)) {
    throw Error(ErrorKind::bad_request, "prefilter: the tolerance is not in 1e-6…0.1");
  }
}

/// Throws for what can't be convolved.
void check_values(const Map& source, const Monitor& monitor) {
  std::atomic<bool> fine{true};
  parallel_for(
      source.charts() * source.height(),
      [&](int i) {
        const float* row = source.level.chart(i / source.height()).row(i % source.height());
        int wrong = 0;
        for (int x = 0; x < source.width() * source.channels(); ++x)
          wrong += std::fabs(row[x]) <= kMostRadiance ? 0 : 1;
        if (wrong > 0) fine = false;
      },
      without_progress(monitor));
  if (!fine)
    throw Error(ErrorKind::bad_value,
                "prefilter: the map has values that are NaN, infinite, or beyond ±1e30");
}

/// See PrefilterOptions::mirror_filter.
Filter mirror_filter(const PrefilterOptions& options, const Map& from,
                     const sphere::AnyParameterization& target, ChartSize size) {
  if (options.mirror_filter != Filter::automatic) return options.mirror_filter;
  const double source = mean_texel(from.parameterization, {from.width(), from.height()});
  return mean_texel(target, size) < 1.5 * source ? Filter::bilinear : Filter::automatic;
}

/// cos, sin of the shift between the columns of two grids, for each order; times the B-spline's transform
/// along the row and the 6 of to_spline_columns.
std::vector<float> turns(int last, int grid_width, int moments_width) {
  std::vector<float> turn;
  for (int m = 0; m <= last; ++m) {
    const double shift = kPi * m * (1.0 / grid_width - 1.0 / moments_width);
    const double spline = 6 * 3 / (2 + std::cos(2 * kPi * m / grid_width));
    turn.push_back(static_cast<float>(spline * std::cos(shift)));
    turn.push_back(static_cast<float>(spline * std::sin(shift)));
  }
  return turn;
}

/// Factors of the orders of rows of boxes, or 1.
std::vector<float> order_factors(const MomentPlan& moments, int last) {
  std::vector<float> factors;
  for (int m = 0; m <= last; ++m) {
    const double x = kPi * m / moments.width;
    const bool box = moments.way == MomentPlan::Way::spread_boxes && m > 0;
    factors.push_back(static_cast<float>(box ? std::sin(x) / x : 1.0));
  }
  return factors;
}

/// Lobes with more degrees than this are split into near and far.
constexpr int kMostDegree = 480;

/// Whether a lobe is to be split into near and far: too many degrees, and most of it near its axis. A narrow
/// ring isn't.
bool is_split(const lobe::AnyLobe& lobe, int degree) {
  return degree > kMostDegree && lobe::angle_holding(lobe, 0.5) < 0.2;
}

/// Rows that a near part is done on. They resolve what is left of the lobe at the scale of `texel`, the wider
/// one of the source and the level, or all of it where it is wider. More of them where that is the source's,
/// whose edges then show.
int near_rows(const sphere::AnyParameterization& source, double source_texel, double texel, int degree) {
  const double of_latlong = source_texel < texel ? 2.3 : 2.65;
  const double per_texel = source.spec() == "latlong" ? of_latlong : 2.8;
  const double rows = std::min(per_texel * kPi / texel, 1.8 * degree);
  return std::max(32, static_cast<int>(std::ceil(rows / 16)) * 16);
}

/// Degree of the far part's harmonics: the near part reaches about as many rows then, however fine they are.
int far_degree(int rows) {
  return std::max(300, rows * 2 / 9);
}

/// Throws when a near part's tables and rows would take more memory than is reasonable.
void check_near_size(int rows, int channels) {
  // Tables, masses and results; the bands of rows between are small.
  const double n = rows, orders = 1.2 * n;
  const double bytes = 4 * (orders / 8 * 30 * n / 2 + 4.4 * n * n * channels);
  constexpr double kMost = 24e9;
  if (bytes > kMost) {
    throw Error(ErrorKind::too_large,
                "prefilter: so narrow a lobe on so fine a level would take " +
                    number_text(std::round(bytes / 1e9)) +
                    " GB of memory: make the level smaller, or the roughness 0 or larger");
  }
}

}  // namespace

HarmonicLevel::HarmonicLevel(const WidenedLobe& widened, const std::vector<double>& coefficients, int number,
                             int moments_width)
    : index(number),
      degree(static_cast<int>(coefficients.size()) - 1),
      grid{fft_length(static_cast<int>(2.2 * degree) + 8), 0},
      fft(grid.width),
      latitudes(grid.width / 2, degree),
      zonal(coefficients.begin(), coefficients.end()),
      turn(turns(degree, grid.width, moments_width)),
      lobe(widened.lobe),
      all(widened.smooth),
      scale(1 / widened.lobe.integral()) {
  grid.height = grid.width / 2;
}

NearLevel::NearLevel(const WidenedLobe& widened, std::size_t number, int rows, int degree, double tolerance,
                     int moments_width)
    : harmonic(number),
      field(widened.lobe, widened.zonal, rows, degree, tolerance),
      grid{fft_length(std::max(2 * rows, 2 * field.last + 4)), rows},
      fft(grid.width),
      turn(turns(field.last, grid.width, moments_width)) {}

NearGroup::NearGroup(const PrefilterShape& source, int rows, int last_order)
    : moments(MomentPlan::with_rows(source.parameterization, source.size, rows)),
      fft(moments.width),
      factors(order_factors(moments, last_order)) {}

PrefilterPlan::PrefilterPlan(const PrefilterShape& source, const sphere::AnyParameterization& target,
                             std::vector<PrefilterLevel> levels, const PrefilterOptions& options) {
  check(source, levels, options);
  auto tables = std::make_shared<Tables>(Tables{source, target, std::move(levels), options});
  // How fine each lobe is decides on the method.
  const double source_texel = mean_texel(source.parameterization, source.size);
  const auto texel_of = [&](std::size_t i) {
    return std::max(source_texel, mean_texel(target, tables->levels[i].size));
  };
  struct Choice {
    WidenedLobe lobe;
    int near_rows;  ///< 0 when the lobe isn't split
  };
  std::vector<std::optional<Choice>> choices(tables->levels.size());
  for (std::size_t i = 0; i < choices.size(); ++i) {
    const PrefilterLevel& level = tables->levels[i];
    if (level.lobe.mirror()) continue;
    choices[i] = {widen(level.lobe, texel_of(i), options.tolerance / 5), 0};
    Choice& choice = *choices[i];
    if (is_split(level.lobe, choice.lobe.degree())) {
      choice.near_rows = near_rows(source.parameterization, source_texel, texel_of(i), choice.lobe.degree());
      check_near_size(choice.near_rows, source.channels);
    }
    tables->degree =
        std::max(tables->degree, choice.near_rows > 0 ? far_degree(choice.near_rows) : choice.lobe.degree());
  }
  if (tables->degree > 0) tables->moments.emplace_back(source.parameterization, source.size, tables->degree);
  for (std::size_t i = 0; i < choices.size(); ++i) {
    if (!choices[i]) {
      tables->methods.push_back({"resample", 0, {}, tables->levels[i].lobe, 0, false});
      if (tables->degree > 0 && options.mirror_filter == Filter::automatic) {
        MomentPlan& moments = tables->moments[0];
        const double texel = mean_texel(target, tables->levels[i].size);
        const double reduced = mean_texel(source.parameterization, {moments.width, moments.height});
        tables->methods.back().reduced =
            moments.reduces() && moments.rows_per_mass > 0 && reduced < 1.2 * texel;
        moments.reduced = moments.reduced || tables->methods.back().reduced;
      }
      continue;
    }
    const auto& [lobe, rows] = *choices[i];
    const int width = tables->moments[0].width;
    if (rows == 0) {
      HarmonicLevel& harmonic = tables->harmonic.emplace_back(lobe, lobe.zonal, static_cast<int>(i), width);
      if (lobe.sigma > 0) harmonic.sampled.emplace_back(lobe.lobe);
      tables->methods.push_back(
          {"harmonics", lobe.degree(), tables->harmonic.back().grid, lobe.lobe, lobe.sigma, false});
      continue;
    }
    auto group =
        std::find_if(tables->near.begin(), tables->near.end(),
                     [height = rows](const NearGroup& each) { return each.moments.height == height; });
    if (group == tables->near.end()) {
      group = tables->near.emplace(tables->near.end(), source, rows, 4 * rows);
    }
    NearLevel& near = group->levels.emplace_back(lobe, tables->harmonic.size(), rows, far_degree(rows),
                                                 options.tolerance / 5, group->moments.width);
    tables->harmonic.emplace_back(lobe, near.field.far, static_cast<int>(i), width).all = true;
    tables->methods.push_back({"near and far", far_degree(rows), near.grid, lobe.lobe, lobe.sigma, false});
  }
  if (!tables->harmonic.empty()) {
    for (int m = 0; m <= tables->degree; ++m) tables->recurrences.emplace_back(m, tables->degree);
    const MomentPlan& moments = tables->moments[0];
    tables->moments_fft.emplace_back(moments.width);
    tables->moments_latitudes.emplace_back(moments.height, tables->degree);
    tables->order_factors = order_factors(moments, tables->degree);
  }
  tables_ = std::move(tables);
}

const std::vector<PrefilterMethod>& PrefilterPlan::methods() const {
  return tables_->methods;
}

std::vector<Map> PrefilterPlan::run(const Map& source, const Monitor& monitor) const {
  const Tables& t = *tables_;
  if (!(source.parameterization == t.source.parameterization) || source.width() != t.source.size.width ||
      source.height() != t.source.size.height || source.channels() != t.source.channels) {
    throw Error(ErrorKind::mismatch, "prefilter: the map has another shape than the plan was made for");
  }
  std::vector<Map> results;
  for (const PrefilterLevel& level : t.levels) {
    Map& map = results.emplace_back(t.target.at_size(level.size.width, level.size.height), level.size.width,
                                    level.size.height, source.channels());
    map.channel_names = source.channel_names;
    map.orientation = t.options.orientation;
  }
  std::optional<Map> reduced;
  if (t.harmonic.empty()) {
    check_values(source, monitor);
  } else {
    reduced = run_harmonics(t, source, results, monitor);
  }
  if (reduced) fill_latlong_border(reduced->level);
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (!t.levels[i].lobe.mirror()) continue;
    const Map& from = reduced && t.methods[i].reduced ? *reduced : source;
    ResampleOptions how;
    how.filter = mirror_filter(t.options, from, results[i].parameterization, t.levels[i].size);
    how.monitor = without_progress(monitor);
    resample(from, results[i], how);
  }
  if (t.options.scale == LobeScale::integral) {
    for (std::size_t i = 0; i < results.size(); ++i) {
      if (!t.levels[i].lobe.mirror()) scale(results[i], static_cast<float>(t.levels[i].lobe.integral()));
    }
  }
  return results;
}

std::vector<Map> prefilter_map(const Map& source, const sphere::AnyParameterization& target,
                               std::vector<PrefilterLevel> levels, const PrefilterOptions& options,
                               const Monitor& monitor) {
  const PrefilterShape shape{source.parameterization, {source.width(), source.height()}, source.channels()};
  return PrefilterPlan(shape, target, std::move(levels), options).run(source, monitor);
}

}  // namespace welkin
