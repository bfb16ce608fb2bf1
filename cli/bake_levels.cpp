#include "bake_levels.h"

#include <fmt/core.h>

namespace welkin::cli {

void BakeLevels::add(Command command) {
  command
      .add_option("--lobe", lobe_spec,
                  "Lobe to filter with (`welkin list lobes`): NAME makes a chain where the lobe has a "
                  "roughness, NAME,PARAMETER=VALUE one map; table,file=PATH")
      .show_default();
  command.add_option("--to", to, "Parameterization of the output: NAME[:LAYOUT][,PARAMETER=VALUE]")
      .show_default();
  command.add_option(
      "--size", size,
      "Size of a chart (a face) of level 0 in texels: N across, or WxH. Default: faces of 256, of 64 for one "
      "wide lobe; about as many texels in other parameterizations; 40x20 for lambert in a latlong");
  command
      .add_option("--levels", count,
                  "Levels of the chain, each half as large as the one before. Default: as many as the list "
                  "of --roughness, or the size, has")
      .within(1, 21);
  command.add_option("--roughness", roughness,
                     "Roughness of each level: a curve (`welkin list curves`) or a list 0,0.1,0.5. Default: "
                     "linear");
  command
      .add_option("--level0", level0,
                  "filtered: for the curve's roughness, of which 0 is the source resampled; source: "
                  "resampled, whatever the curve says")
      .one_of({"filtered", "source"})
      .show_default();
  command
      .add_option("--method", method,
                  "exact, or paraboloid-convolution: an approximation of 2000, into --to paraboloid")
      .show_default();
}

void BakeLevels::check_one_lobe(const lobe::AnyLobe& lobe) const {
  const char* option = !roughness.empty()      ? "--roughness"
                       : count.value_or(1) > 1 ? "--levels"
                       : level0 == "source"    ? "--level0"
                                               : nullptr;
  if (option == nullptr) return;
  throw UsageError(
      fmt::format("{}: {} is one lobe, and makes one map{}", option, printable(lobe_spec),
                  lobe.has_roughness() ? fmt::format("; for a chain write --lobe {}", lobe.name()) : ""));
}

void BakeLevels::parse(const std::string& out, const WriteFlags& write) {
  // A lobe's roughness is its only parameter, so that whoever gives one has chosen it.
  options.lobe = parse_option("--lobe", [&] { return lobe::AnyLobe::make(lobe_spec); });
  options.chain = options.lobe.has_roughness() && lobe_spec.find(',') == std::string::npos;
  if (!options.chain) check_one_lobe(options.lobe);
  shape = parse_option("--to", [&] { return parse_map_shape_for(out, to); });
  options.target = shape->parameterization;
  options.method = parse_option("--method", [&] { return bake_method_from_name(method); });
  if (options.method == BakeMethod::paraboloid_convolution && options.target.name() != "paraboloid")
    throw UsageError(fmt::format("--method: {} makes paraboloid maps, not {}: give --to paraboloid", method,
                                 options.target.spec()));
  if (!size.empty()) options.size = parse_chart_size("--size", size, options.target);
  if (options.chain) {
    options.levels = count.value_or(0);
    options.mirror_level0 = level0 == "source";
    if (!roughness.empty()) {
      options.curve = parse_option("--roughness", [&] { return lobe::RoughnessCurve::from_name(roughness); });
    }
  }
  const ChartSize finest = default_bake_size(options);
  // More levels than the size has are refused where the file is known.
  const int all = options.chain ? bake_level_count(options) : 1;
  shape = parse_map_shape_for(out, to, all);
  check_output_size(finest, *shape, write);
  check_output_levels(out, *shape, finest, all, write);
  levels = parse_option("--roughness", [&] { return bake_levels(options); });
  check_output(out, *shape, write);
}

}  // namespace welkin::cli
