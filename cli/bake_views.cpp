#include "bake_views.h"
#include "json_text.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "welkin/base/number_text.h"
#include "welkin/map_file/view_chains_file.h"
#include "welkin/prefilter/lobe_sum_bake.h"
#include "welkin/prefilter/view_bake.h"

namespace welkin::cli {
namespace {

using nlohmann::ordered_json;

constexpr int kDefaultViews = 16;

/// A row for each angle of view.
ordered_json rows_of(const ViewTable& table) {
  ordered_json rows = ordered_json::array();
  for (std::size_t i = 0; i < table.values.size(); i += static_cast<std::size_t>(table.levels))
    rows.push_back(std::vector(table.values.begin() + static_cast<std::ptrdiff_t>(i),
                               table.values.begin() + static_cast<std::ptrdiff_t>(i) + table.levels));
  return rows;
}

/// The angle of view whose cosine is nearest.
std::size_t nearest(const std::vector<double>& cosines, double cosine) {
  std::size_t best = 0;
  for (std::size_t k = 0; k < cosines.size(); ++k) {
    if (std::fabs(cosines[k] - cosine) < std::fabs(cosines[best] - cosine)) best = k;
  }
  return best;
}

}  // namespace

void BakeViews::add(Command command) {
  command.add_option("--brdf", spec,
                     "Filter with a BRDF's lobe as it is seen from several angles: ggx, ward (a chain over "
                     "roughness), NAME,roughness=VALUE (one level), table,file=PATH, merl,file=PATH");
  command
      .add_option("--views", views, "With --brdf: how many angles of view, each a layer of OUT; default 16")
      .within(1, 256);
  command
      .add_option(
          "--axis", axis,
          "With --brdf: lobes are averaged about the axis that suits them best (fitted), or about the "
          "reflected direction")
      .one_of({"fitted", "reflected"})
      .show_default();
  command
      .add_option(
          "--lobes", lobes,
          "With --brdf: no layers, but one chain of --lobe and a table of which of its texels to add, "
          "so many for each angle of view and roughness")
      .within(1, 16);
}

bool BakeViews::asked() const {
  if (!spec.empty()) return true;
  if (views || lobes || axis != "fitted")
    throw UsageError(fmt::format("{}: of what? name it with --brdf", views   ? "--views"
                                                                     : lobes ? "--lobes"
                                                                             : "--axis"));
  return false;
}

void BakeViews::prepare(BakeLevels& made, const std::string& out) {
  brdf_ = parse_option("--brdf", [&] { return brdf::AnyBrdf::make(spec); });
  if (brdf_->is_mirror())
    throw UsageError("--brdf: " + printable(spec) + " is a mirror, which needs no filter");
  if (lobes) {
    if (axis != "fitted") throw UsageError("--axis: with --lobes each has its own");
    const lobe::AnyLobe lobe = parse_option("--lobe", [&] { return lobe::AnyLobe::make(made.lobe_spec); });
    if (!lobe.has_roughness() || made.lobe_spec.find(',') != std::string::npos)
      throw UsageError("--lobe: lobes are added from a chain: name one with a roughness, without its value");
    return;
  }
  if (made.lobe_spec != BakeLevels().lobe_spec) throw UsageError("--lobe: --brdf says what to filter with");
  const bool chain = brdf_->has_roughness() && spec.find("roughness=") == std::string::npos;
  const io::Capabilities& format = io::capabilities_for(out);
  if (!format.texture && !format.pictures)
    throw UsageError(printable(out) +
                     ": holds one picture, not one for each angle of view: write KTX2 or EXR");
  if (chain && !format.texture)
    throw UsageError(printable(out) +
                     ": a chain for each angle of view goes into a KTX2; for EXR name one "
                     "roughness, as in --brdf ggx,roughness=0.5");
  // Of the lobe of a stack only how wide it is matters here.
  if (!chain)
    made.lobe_spec =
        brdf_->has_roughness() ? "ggx,roughness=" + number_text(brdf_->roughness()) : "phong,exponent=1000";
}

void BakeViews::run(const Map& source, const BakeLevels& made, const std::string& in, const std::string& out,
                    const WriteMapOptions& write, bool json) const {
  for (const std::string& note : brdf_->notes())
    print_message(fmt::format("welkin: {}: {}\n", printable(brdf_->spec()), note));
  lobes ? run_sums(source, made, in, out, write, json) : run_stack(source, made, in, out, write, json);
}

void BakeViews::run_stack(const Map& source, const BakeLevels& made, const std::string& in,
                          const std::string& out, const WriteMapOptions& write, bool json) const {
  ViewBakeOptions options;
  options.brdf = *brdf_;
  options.view_cosines = default_view_cosines(views.value_or(kDefaultViews));
  options.axis = axis == "fitted" ? brdf::LobeAxis::fitted : brdf::LobeAxis::reflected;
  options.bake = made.options;
  const ViewBakePlan plan({source.parameterization, {source.width(), source.height()}, source.channels()},
                          options);
  for (const std::string& warning : plan.warnings()) {
    if (warning.starts_with("reflects"))
      print_message(fmt::format("welkin: {}: {}\n", printable(brdf_->spec()), warning));
  }
  const ViewChains stack = plan.run(source, progress_monitor("bake"));
  end_progress();
  report_losses(out, write_view_chains(out, stack, write));
  const ViewNotes& notes = stack.notes;
  const std::vector<double>& roughness = stack.views.front().notes.roughness;
  const std::vector<Map>& levels = stack.views.front().levels;
  if (json) {
    ordered_json report{{"in", in},
                        {"out", out},
                        {"brdf", notes.brdf},
                        {"axis", notes.axis},
                        {"view_cosines", notes.view_cosines}};
    report["roughness"] = roughness;
    report["width"] = levels.front().width();
    report["height"] = levels.front().height();
    report["levels"] = levels.size();
    report["lift"] = rows_of(notes.lift);
    report["albedo"] = rows_of(notes.albedo);
    return print_json_text(report);
  }
  fmt::print("{}: {} from {} angles, axis {}, {} {}\n", printable(out), printable(notes.brdf),
             notes.view_cosines.size(), notes.axis, levels.size(), levels.size() == 1 ? "level" : "levels");
  const std::size_t grazing = nearest(notes.view_cosines, 0.1), middle = nearest(notes.view_cosines, 0.5);
  fmt::print("level       size  roughness  lift, albedo at n·v {:.3f}  at n·v {:.3f}\n",
             notes.view_cosines[grazing], notes.view_cosines[middle]);
  for (std::size_t k = 0; k < levels.size(); ++k) {
    const std::string size = fmt::format("{}x{}", levels[k].width(), levels[k].height());
    fmt::print("{:>5}  {:>9}  {:>9}  {:>12.3f} {:>12.3f}  {:>6.3f} {:>6.3f}\n", k, size,
               k < roughness.size() ? fmt::format("{:.6g}", roughness[k]) : "–", notes.lift.at(grazing, k),
               notes.albedo.at(grazing, k), notes.lift.at(middle, k), notes.albedo.at(middle, k));
  }
}

void BakeViews::run_sums(const Map& source, const BakeLevels& made, const std::string& in,
                         const std::string& out, const WriteMapOptions& write, bool json) const {
  LobeSumOptions options;
  options.brdf = *brdf_;
  options.view_cosines = default_view_cosines(views.value_or(kDefaultViews));
  options.count = *lobes;
  options.bake = made.options;
  if (brdf_->has_roughness() && spec.find("roughness=") != std::string::npos)
    options.roughness = {brdf_->roughness()};
  const LobeSumChain chain = bake_lobe_sums(source, options, progress_monitor("bake"));
  end_progress();
  report_losses(out, write_lobe_sums(out, chain, write));
  const LobeSums& sums = chain.sums;
  if (json) {
    ordered_json report{{"in", in},
                        {"out", out},
                        {"brdf", sums.brdf},
                        {"view_cosines", sums.view_cosines},
                        {"roughness", sums.roughness}};
    report["lobe"] = chain.chain.notes.lobe;
    report["level_roughness"] = chain.chain.notes.roughness;
    for (std::size_t view = 0; view < sums.view_cosines.size(); ++view) {
      ordered_json row = ordered_json::array();
      for (std::size_t k = 0; k < sums.roughness.size(); ++k) {
        ordered_json list = ordered_json::array();
        for (int i = 0; i < sums.count; ++i) {
          const LobeLookUp& each = sums.at(view, k)[i];
          list.push_back({{"weight", each.weight}, {"level", each.level}, {"lift", each.lift}});
        }
        row.push_back(std::move(list));
      }
      report["look_ups"].push_back(std::move(row));
    }
    report["albedo"] = rows_of(sums.albedo);
    return print_json_text(report);
  }
  fmt::print("{}: {} as sums of up to {} of a chain of {}, {} levels, for {} angles and {} roughnesses\n",
             printable(out), printable(sums.brdf), sums.count, chain.chain.notes.lobe,
             chain.chain.levels.size(), sums.view_cosines.size(), sums.roughness.size());
  const std::size_t grazing = nearest(sums.view_cosines, 0.1);
  fmt::print("roughness  at n·v {:.3f}: weight × level, lift\n", sums.view_cosines[grazing]);
  for (std::size_t k = 0; k < sums.roughness.size(); ++k) {
    fmt::print("{:>9.6g} ", sums.roughness[k]);
    for (int i = 0; i < sums.count; ++i) {
      const LobeLookUp& each = sums.at(grazing, k)[i];
      if (each.weight > 0) fmt::print("  {:.2f} × {:.2f}, {:.2f}", each.weight, each.level, each.lift);
    }
    fmt::print("\n");
  }
}

}  // namespace welkin::cli
