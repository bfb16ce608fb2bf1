#include "welkin/prefilter/bake.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "welkin/base/error.h"
#include "welkin/base/parallel.h"
#include "welkin/base/version.h"
#include "welkin/filter/resample.h"
#include "welkin/map/adjust.h"
#include "welkin/prefilter/roughness_levels.h"
#include "welkin/prefilter/source_faults.h"

namespace welkin {
namespace {

/// Faces of chains, and of one lobe as wide as this (radians) or wider.
constexpr int kChainFace = 256, kWideFace = 64;
constexpr double kWide = 0.15;
/// Diffuse light by Greene 1986.
constexpr ChartSize kDiffuseLatlong{40, 20};

bool is_chain(const BakeOptions& options) {
  return options.chain && options.lobe.has_roughness();
}

/// A chart whose width is the power of two with about as many texels in all charts as a cube with such faces.
ChartSize size_like_cube(const sphere::AnyParameterization& target, int face) {
  const double like = face * std::sqrt(6 * target.aspect() / target.charts());
  const int width = std::max(1, static_cast<int>(std::exp2(std::round(std::log2(like)))));
  return {width, std::max(1, static_cast<int>(std::lround(width / target.aspect())))};
}

bool drops_alpha(const Map& map, bool keep_alpha) {
  return !keep_alpha && map.channel_names == std::vector<std::string>{"R", "G", "B", "A"};
}

PrefilterShape shape_of(const Map& map, bool keep_alpha) {
  return {
      map.parameterization, {map.width(), map.height()}, drops_alpha(map, keep_alpha) ? 3 : map.channels()};
}

/// Whose levels the method makes.
void check_method(const BakeOptions& options, ChartSize finest) {
  if (options.method == BakeMethod::exact) return;
  if (options.target.name() != "paraboloid") {
    throw Error(ErrorKind::bad_request,
                "paraboloid-convolution makes paraboloid maps, not " + options.target.spec());
  }
  require(finest.width == finest.height, "paraboloid-convolution makes square faces");
  paraboloid_filters(options.lobe, finest.width, options.paraboloid);
}

/// The levels of a map by convolution: all from the map as level 0 would show it.
std::vector<Map> convolve_levels(const Map& source, const BakeOptions& options,
                                 const std::vector<PrefilterLevel>& levels, const Monitor& monitor) {
  Map first(options.target, levels.front().size.width, levels.front().size.height, source.channels());
  first.channel_names = source.channel_names;
  first.orientation = options.prefilter.orientation;
  ResampleOptions resampling;
  resampling.monitor = part_of(monitor, 0, 0.3);
  resample(source, first, resampling);
  std::vector<Map> made;
  for (const PrefilterLevel& level : levels) {
    const double begin = 0.3 + 0.7 * static_cast<double>(made.size()) / static_cast<double>(levels.size());
    made.push_back(
        convolve_paraboloid(first, level.lobe, level.size, options.paraboloid,
                            part_of(monitor, begin, begin + 0.7 / static_cast<double>(levels.size()))));
    if (options.prefilter.scale == LobeScale::integral && !level.lobe.is_mirror())
      scale(made.back(), static_cast<float>(level.lobe.integral()));
  }
  return made;
}

}  // namespace

BakeMethod bake_method_from_name(std::string_view name) {
  if (name == "exact") return BakeMethod::exact;
  if (name == "paraboloid-convolution") return BakeMethod::paraboloid_convolution;
  const std::array<std::string, 2> names{"exact", "paraboloid-convolution"};
  throw Error(ErrorKind::bad_request, unknown_name("method", name, names));
}

ChartSize default_bake_size(const BakeOptions& options) {
  if (options.size) return *options.size;
  if (options.lobe.name() == "lambert" && options.target.traits().latlong_grid) return kDiffuseLatlong;
  const bool wide = !is_chain(options) && !options.lobe.is_mirror() && options.lobe.width() >= kWide;
  return size_like_cube(options.target, wide ? kWideFace : kChainFace);
}

int bake_level_count(const BakeOptions& options) {
  if (!is_chain(options)) return 1;
  const int listed = options.curve.listed_levels();
  return options.levels > 0 ? options.levels : listed > 0 ? listed : max_levels(default_bake_size(options));
}

std::vector<PrefilterLevel> bake_levels(const BakeOptions& options) {
  const ChartSize finest = default_bake_size(options);
  check_method(options, finest);
  if (!is_chain(options)) {
    require(options.levels <= 1 && options.curve.listed_levels() <= 1,
            "one lobe makes one level: a chain is of a lobe that has a roughness");
    require(!options.mirror_level0, "one lobe makes one level, which is filtered");
    return {{finest, options.lobe}};
  }
  const int count = bake_level_count(options);
  if (count > max_levels(finest)) {
    throw Error(ErrorKind::bad_request,
                "charts of " + std::to_string(finest.width) + "x" + std::to_string(finest.height) + " have " +
                    std::to_string(max_levels(finest)) + " levels, not " + std::to_string(count));
  }
  std::vector<PrefilterLevel> levels = roughness_levels(options.lobe, options.curve, finest, count);
  if (options.mirror_level0) levels.front().lobe = lobe::AnyLobe::mirror();
  return levels;
}

ChainNotes bake_notes(const BakeOptions& options) {
  const lobe::AnyLobe& lobe = options.lobe;
  ChainNotes notes;
  notes.lobe = lobe.has_roughness() ? lobe.name() : lobe.spec();
  if (is_chain(options) && options.curve.listed_levels() == 0) notes.curve = options.curve.text();
  notes.normalisation = options.prefilter.scale == LobeScale::integral ? "integral" : "radiance";
  notes.software = "welkin " + std::string(version());
  if (!lobe.has_roughness()) return notes;
  for (const PrefilterLevel& level : bake_levels(options))
    notes.roughness.push_back(roughness_of(level.lobe).value_or(0));
  return notes;
}

BakePlan::BakePlan(const PrefilterShape& source, const BakeOptions& options)
    : options_(options), levels_(bake_levels(options)), notes_(bake_notes(options)) {
  if (options.method == BakeMethod::exact) {
    plan_.emplace(source, options.target, levels_, options.prefilter);
    methods_ = plan_->methods();
    return;
  }
  for (const PrefilterLevel& level : levels_)
    methods_.push_back({level.lobe.is_mirror() ? "resample" : "convolution", 0, {}, level.lobe});
}

BakePlan::BakePlan(const Map& source, const BakeOptions& options)
    : BakePlan(shape_of(source, options.keep_alpha), options) {}

Chain BakePlan::run(const Map& source, const Monitor& monitor) const {
  if (drops_alpha(source, options_.keep_alpha)) return run(without_alpha(source), monitor);
  if (plan_) return {plan_->run(source, monitor), notes_};
  SourceFaults faults;
  return run(source, faults, monitor);
}

Chain BakePlan::run(const Map& source, SourceFaults& faults, const Monitor& monitor) const {
  if (drops_alpha(source, options_.keep_alpha)) return run(without_alpha(source), faults, monitor);
  if (plan_) return {plan_->run(source, faults, monitor), notes_};
  faults = faults_of(source, without_progress(monitor));
  if (faults.not_finite + faults.excessive > 0) {
    throw Error(ErrorKind::bad_value,
                "paraboloid-convolution: the map has values that are NaN, infinite, or beyond ±1e30");
  }
  return {convolve_levels(source, options_, levels_, monitor), notes_};
}

Chain bake(const Map& source, const BakeOptions& options, const Monitor& monitor) {
  return BakePlan(source, options).run(source, monitor);
}

}  // namespace welkin
