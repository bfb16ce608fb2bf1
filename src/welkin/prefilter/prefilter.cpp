#include "welkin/prefilter/prefilter.h"

#include <optional>

#include "welkin/base/error.h"
#include "welkin/base/parallel.h"
#include "welkin/filter/resample.h"
#include "welkin/map/adjust.h"
#include "welkin/map/borders.h"
#include "welkin/prefilter/plan.h"

namespace welkin {
namespace {

using namespace prefilter;

/// Throws for what can't be convolved.
void check_values(const SourceFaults& faults) {
  if (faults.not_finite + faults.excessive > 0)
    throw Error(ErrorKind::bad_value,
                "prefilter: the map has values that are NaN, infinite, or beyond ±1e30");
}

}  // namespace

Map PrefilterPlan::Tables::result(std::size_t level, const Map& map) const {
  const auto [width, height] = levels[level].size;
  Map made(target.at_size(width, height), width, height, map.channels(),
           options.borders ? PixelContents::unset : PixelContents::zero);
  made.channel_names = map.channel_names;
  made.orientation = options.orientation;
  return made;
}

std::vector<Map> PrefilterPlan::run(const Map& source, const Monitor& monitor) const {
  return run(source, nullptr, monitor);
}

std::vector<Map> PrefilterPlan::run(const Map& source, SourceFaults& faults, const Monitor& monitor) const {
  faults = {};
  return run(source, &faults, monitor);
}

std::vector<Map> PrefilterPlan::run(const Map& source, SourceFaults* faults, const Monitor& monitor) const {
  source.check();
  const Tables& t = *tables_;
  if (!(source.parameterization == t.source.parameterization) || source.width() != t.source.size.width ||
      source.height() != t.source.size.height || source.channels() != t.source.channels) {
    throw Error(ErrorKind::mismatch, "prefilter: the map has another shape than the plan was made for");
  }
  HarmonicResults harmonic;
  std::optional<HarmonicResults> coarse;
  bool negative = false;
  if (t.coarse) coarse = run_coarse(t, source, negative, monitor);
  if (t.harmonic.empty() || (faults != nullptr && (!coarse || negative))) {
    const SourceFaults found = faults_of(source, without_progress(monitor));
    if (faults != nullptr) *faults = found;
    check_values(found);
  }
  if (!t.harmonic.empty()) harmonic = coarse ? std::move(*coarse) : run_harmonics(t, source, monitor);
  std::vector<Map> results;
  auto next = harmonic.levels.begin();
  for (std::size_t i = 0; i < t.levels.size(); ++i) {
    if (!t.levels[i].lobe.is_mirror()) {
      Map& map = results.emplace_back(std::move(*next++));
      if (t.options.scale == LobeScale::integral) scale(map, static_cast<float>(t.levels[i].lobe.integral()));
    } else {
      Map& map = results.emplace_back(t.result(i, source));
      ResampleOptions how;
      how.filter = t.options.mirror_filter;
      how.monitor = without_progress(monitor);
      how.borders = false;
      resample(source, map, how);
    }
    if (t.options.borders) fill_borders(results.back());
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
