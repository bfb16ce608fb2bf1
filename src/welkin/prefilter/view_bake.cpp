#include "welkin/prefilter/view_bake.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "welkin/base/error.h"
#include "welkin/base/number_text.h"
#include "welkin/base/parallel.h"
#include "welkin/base/version.h"
#include "welkin/map/adjust.h"
#include "welkin/map/texel_points.h"
#include "welkin/prefilter/table_digits.h"
#include "welkin/prefilter/widen.h"

namespace welkin {
namespace {

constexpr std::size_t kMaxViews = 256;
/// A mirror's albedo is that of a surface this rough.
constexpr double kNearMirror = 0.02;

void check_cosines(const std::vector<double>& cosines) {
  require(!cosines.empty() && cosines.size() <= kMaxViews, "a stack has 1 to 256 angles of view");
  double before = 0;
  for (const double cosine : cosines) {
    require(cosine > before && cosine <= 1, "the cosines of the angles of view ascend in 0…1");
    before = cosine;
  }
}

/// Of the levels, and of lobes where there is no roughness: BakeOptions with a lobe that has one or hasn't.
BakeOptions sizes_of(const ViewBakeOptions& options) {
  BakeOptions bake = options.bake;
  bake.lobe = lobe::AnyLobe::make(options.brdf.has_roughness() ? "ggx" : "lambert");
  if (!options.brdf.has_roughness() && !bake.size) {
    bake.lobe = lobe::AnyLobe::make("phong,exponent=1000");  // as large as a sharp lobe needs
    bake.chain = false;
  }
  if (bake.lobe.has_roughness() && !bake.chain)
    bake.lobe = bake.lobe.with_roughness(options.brdf.roughness());
  return bake;
}

/// A lobe of the stack.
struct Slot {
  std::size_t view, level;
  brdf::AnyBrdf brdf;
};

std::string percent_text(double part) {
  return number_text(std::round(1000 * part) / 10) + " %";
}

}  // namespace

/// What a plan is made of.
struct ViewBakePlan::Made {
  std::vector<ChartSize> sizes;
  ChainNotes chain_notes;
  ViewNotes notes;
  std::vector<std::string> warnings;
  std::vector<std::size_t> index;
  std::vector<PrefilterLevel> levels;

  Made(const PrefilterShape& source, const ViewBakeOptions& options)
      : source_texel(mean_texel(source.parameterization, source.size)) {
    check_cosines(options.view_cosines);
    require(options.bake.prefilter.scale == LobeScale::average,
            "a stack holds averages: its albedo is kept beside it");
    const BakeOptions bake = sizes_of(options);
    const bool rough = options.brdf.has_roughness();
    const std::vector<PrefilterLevel> like = bake_levels(bake);
    chain_notes = bake_notes(bake);
    chain_notes.lobe = "brdf " + (rough && bake.chain ? options.brdf.name() : options.brdf.spec());
    if (!rough) chain_notes.roughness.clear();
    notes.brdf = rough && bake.chain ? without_roughness(options.brdf) : options.brdf.spec();
    notes.axis = options.axis == brdf::LobeAxis::fitted ? "fitted" : "reflected";
    notes.view_cosines = options.view_cosines;
    warnings = options.brdf.notes();
    for (const PrefilterLevel& each : like) sizes.push_back(each.size);
    add_lobes(options, bake);
  }

 private:
  double source_texel;

  static std::string without_roughness(const brdf::AnyBrdf& brdf) {
    const brdf::AnyBrdf plain = brdf::AnyBrdf::make(brdf.name());
    return brdf.with_roughness(plain.roughness()).spec();
  }

  void add_lobes(const ViewBakeOptions& options, const BakeOptions& bake) {
    const std::size_t views = options.view_cosines.size(), count = sizes.size();
    notes.lift = notes.albedo = {static_cast<int>(count), std::vector<double>(views * count, 0.0)};
    index.resize(views * count);
    // Mirrors are the same from everywhere, and made once.
    std::vector<std::optional<std::size_t>> mirrors(count);
    std::vector<Slot> slots;
    for (std::size_t level = 0; level < count; ++level) {
      brdf::AnyBrdf brdf = options.brdf;
      const bool source = bake.chain && bake.mirror_level0 && level == 0;
      if (brdf.has_roughness() && bake.chain)
        brdf = brdf.with_roughness(source ? 0.0 : chain_notes.roughness[level]);
      const bool mirror = brdf.is_mirror();
      if (mirror) {
        mirrors[level] = levels.size();
        levels.push_back({sizes[level], lobe::AnyLobe::mirror()});
      }
      for (std::size_t view = 0; view < views; ++view) {
        if (mirror) {
          index[view * count + level] = *mirrors[level];
          notes.albedo.values[view * count + level] = prefilter::table_digits(
              brdf::directional_albedo(brdf.with_roughness(kNearMirror), options.view_cosines[view]));
          continue;
        }
        index[view * count + level] = levels.size() + slots.size();
        slots.push_back({view, level, brdf});
      }
      if (!mirror) fill(slots, options, count);
    }
    for (std::size_t i = 0; i < notes.albedo.values.size(); ++i) {
      if (notes.albedo.values[i] <= 1.005) continue;
      warnings.push_back("reflects " + percent_text(notes.albedo.values[i]) +
                         " of the light at n·v = " + number_text(notes.view_cosines[i / count]));
      break;
    }
  }

  /// Averages the lobes of the slots, and empties them.
  void fill(std::vector<Slot>& slots, const ViewBakeOptions& options, std::size_t count) {
    std::vector<std::optional<brdf::AveragedLobe>> made(slots.size());
    parallel_for(static_cast<int>(slots.size()), [&](int i) {
      const Slot& slot = slots[static_cast<std::size_t>(i)];
      auto& lobe = made[static_cast<std::size_t>(i)];
      lobe = brdf::average_lobe(slot.brdf, options.view_cosines[slot.view], options.axis);
      // An average has cusps and edges that texels don't show and that would cost many degrees.
      const double texel = std::max(source_texel, mean_texel(options.bake.target, sizes[slot.level]));
      lobe->lobe = prefilter::without_finer_than(lobe->lobe, texel, options.bake.prefilter.tolerance / 5);
    });
    for (std::size_t i = 0; i < slots.size(); ++i) {
      const Slot& slot = slots[i];
      const double cosine = options.view_cosines[slot.view], from_normal = std::acos(cosine);
      const std::size_t at = slot.view * count + slot.level;
      // At n·v = 1 there is no angle to go along.
      notes.lift.values[at] = from_normal > 1e-6 ? prefilter::table_digits(made[i]->tilt / from_normal) : 0.0;
      notes.albedo.values[at] = prefilter::table_digits(made[i]->albedo);
      levels.push_back({sizes[slot.level], made[i]->lobe});
    }
    slots.clear();
  }
};

ViewBakePlan::ViewBakePlan(const PrefilterShape& source, const ViewBakeOptions& options)
    : ViewBakePlan(source, options, Made(source, options)) {}

ViewBakePlan::ViewBakePlan(const PrefilterShape& source, const ViewBakeOptions& options, Made made)
    : sizes_(std::move(made.sizes)),
      chain_notes_(std::move(made.chain_notes)),
      notes_(std::move(made.notes)),
      warnings_(std::move(made.warnings)),
      index_(std::move(made.index)),
      filtered_(std::move(made.levels)),
      plan_(std::make_shared<PrefilterPlan>(source, options.bake.target, filtered_, options.bake.prefilter)) {
}

ViewChains ViewBakePlan::run(const Map& source, const Monitor& monitor) const {
  std::vector<Map> maps = plan_->run(source, monitor);
  ViewChains stack;
  stack.notes = notes_;
  std::vector<std::size_t> uses(maps.size(), 0);
  for (const std::size_t each : index_) ++uses[each];
  for (std::size_t view = 0; view < notes_.view_cosines.size(); ++view) {
    Chain& chain = stack.views.emplace_back();
    chain.notes = chain_notes_;
    for (std::size_t level = 0; level < sizes_.size(); ++level) {
      const std::size_t which = index_[view * sizes_.size() + level];
      chain.levels.push_back(--uses[which] > 0 ? maps[which].clone() : std::move(maps[which]));
    }
  }
  return stack;
}

const lobe::AnyLobe& ViewBakePlan::lobe_of(std::size_t view, std::size_t level) const {
  require(view < notes_.view_cosines.size() && level < sizes_.size(), "there is no such view or level");
  return filtered_[index_[view * sizes_.size() + level]].lobe;
}

ViewChains bake_views(const Map& source, const ViewBakeOptions& options, const Monitor& monitor) {
  const bool drops = !options.bake.keep_alpha && source.channel_names == default_channel_names(4);
  const PrefilterShape shape{
      source.parameterization, {source.width(), source.height()}, drops ? 3 : source.channels()};
  const ViewBakePlan plan(shape, options);
  return drops ? plan.run(without_alpha(source), monitor) : plan.run(source, monitor);
}

}  // namespace welkin
