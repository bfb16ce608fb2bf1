#include "welkin/filter/resample.h"

#include <algorithm>
#include <cmath>

#include "welkin/base/error.h"
#include "welkin/base/parallel.h"
#include "welkin/filter/resample_job.h"
#include "welkin/map/borders.h"

namespace welkin {
namespace {

/// Writes the fill to every texel that is not valid.
void fill_outside(Map& map, std::vector<float> fill) {
  fill.resize(static_cast<std::size_t>(map.channels()), 0.0f);
  parallel_for(map.charts() * map.height(), [&](int i) {
    const int chart = i / map.height(), y = i % map.height();
    for (int x = 0; x < map.width(); ++x) {
      if (!map.parameterization.valid(chart, (x + 0.5) / map.width(), (y + 0.5) / map.height())) {
        std::copy(fill.begin(), fill.end(), map.level.chart(chart).at(x, y));
      }
    }
  });
}

}  // namespace

namespace {

void resample_charts(const Map& source, Map& target, const ResampleOptions& options) {
  const bool same = source.parameterization == target.parameterization && source.width() == target.width() &&
                    source.height() == target.height() &&
                    source.orientation * transpose(options.rotation) == target.orientation;
  if (same) {
    for (int chart = 0; chart < source.charts(); ++chart) {
      copy_pixels(source.level.chart(chart), target.level.chart(chart));
    }
    if (!target.parameterization.full_charts() && !target.parameterization.filled_to_edges())
      fill_outside(target, options.fill);
    return;
  }
  const ResampleJob job(source, target, options);
  if (options.filter == Filter::automatic) {
    resample_areas(job);
  } else {
    resample_points(job, job.fetch_of(options.filter));
  }
}

}  // namespace

void resample(const Map& source, Map& target, const ResampleOptions& options) {
  source.check();
  target.check();
  require(&source != &target, "a map is resampled into another");
  require(source.channels() == target.channels(),
          "the maps to resample between have other numbers of channels");
  require(is_orthonormal(options.rotation), "a world is turned by a rotation or a reflection");
  resample_charts(source, target, options);
  if (options.borders) fill_borders(target);
}

ChartSize default_chart_size(const Map& map, const sphere::AnyParameterization& parameterization) {
  // The valid part of its charts' area, on a grid fine enough for a few per mille.
  const auto used = [](const sphere::AnyParameterization& p) {
    constexpr int kGrid = 64;
    int valid = 0;
    for (int i = 0; i < kGrid * kGrid; ++i) {
      if (p.valid(0, (i % kGrid + 0.5) / kGrid, (i / kGrid + 0.5) / kGrid)) ++valid;
    }
    return static_cast<double>(valid) / (kGrid * kGrid) * p.charts();
  };
  const double per_steradian =
      used(map.parameterization) * map.width() * map.height() / map.parameterization.coverage();
  const double texels = per_steradian * parameterization.coverage() / used(parameterization);
  const int width =
      std::max(2, 2 * static_cast<int>(std::lround(0.5 * std::sqrt(texels * parameterization.aspect()))));
  return {width, std::max(1, static_cast<int>(std::lround(width / parameterization.aspect())))};
}

}  // namespace welkin
