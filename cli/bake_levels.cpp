#include "bake_levels.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "version.h"
#include "welkin/prefilter/roughness_levels.h"

namespace welkin::cli {
namespace {

/// Faces of chains, and of one lobe as wide as this (radians) or wider.
constexpr int kChainFace = 256, kWideFace = 64;
constexpr double kWide = 0.15;
/// Diffuse light by Greene 1986.
constexpr ChartSize kDiffuseLatlong{40, 20};

/// The power of two whose charts have about as many texels together as a cube with such faces.
int side_like_cube(const sphere::AnyParameterization& target, int face) {
  const double width = face * std::sqrt(6 * target.aspect() / target.charts());
  return std::max(1, static_cast<int>(std::exp2(std::round(std::log2(width)))));
}

}  // namespace

void BakeLevels::add(CLI::App& command) {
  command
      .add_option("--lobe", lobe_spec,
                  "Lobe to filter with (`welkin list lobes`): NAME makes a chain where the lobe has a "
                  "roughness, NAME,PARAMETER=VALUE one map; table,file=PATH")
      ->capture_default_str();
  command.add_option("--to", to, "Parameterization of the output: NAME[:LAYOUT][,PARAMETER=VALUE]")
      ->capture_default_str();
  command.add_option(
      "--size", size,
      "Size of a chart (a face) of level 0 in texels: N across, or WxH. Default: faces of 256, of 64 for one "
      "wide lobe; about as many texels in other parameterizations; 40x20 for lambert in a latlong");
  command
      .add_option("--levels", count,
                  "Levels of the chain, each half as large as the one before. Default: as many as the list "
                  "of --roughness, or the size, has")
      ->check(CLI::Range(1, 21));
  command.add_option("--roughness", roughness,
                     "Roughness of each level: a curve (`welkin list curves`) or a list 0,0.1,0.5. Default: "
                     "linear");
  command
      .add_option("--level0", level0,
                  "filtered: for the curve's roughness, of which 0 is the source resampled; source: "
                  "resampled, whatever the curve says")
      ->check(CLI::IsMember({"filtered", "source"}))
      ->capture_default_str();
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

ChartSize BakeLevels::default_size(const sphere::AnyParameterization& target,
                                   const lobe::AnyLobe& lobe) const {
  if (lobe.name() == "lambert" && target.name() == "latlong") return kDiffuseLatlong;
  const bool wide = !chain && !lobe.mirror() && lobe.width() >= kWide;
  const int width = side_like_cube(target, wide ? kWideFace : kChainFace);
  return parse_chart_size("--size", std::to_string(width), target);
}

void BakeLevels::parse(const std::string& out, const WriteFlags& write) {
  // A lobe's roughness is its only parameter, so that whoever gives one has chosen it.
  const lobe::AnyLobe lobe = parse_option("--lobe", [&] { return lobe::AnyLobe::make(lobe_spec); });
  chain = lobe.has_roughness() && lobe_spec.find(',') == std::string::npos;
  if (!chain) check_one_lobe(lobe);
  shape = parse_option("--to", [&] { return parse_map_shape_for(out, to); });
  const ChartSize finest = size.empty() ? default_size(shape->parameterization, lobe)
                                        : parse_chart_size("--size", size, shape->parameterization);
  std::string curve_name;
  if (chain) {
    const lobe::RoughnessCurve curve = parse_option("--roughness", [&] {
      return lobe::RoughnessCurve::from_name(roughness.empty() ? "linear" : roughness);
    });
    const int own = curve.listed_levels() > 0 ? curve.listed_levels() : max_levels(finest);
    levels = parse_option("--roughness",
                          [&] { return roughness_levels(lobe, curve, finest, count.value_or(own)); });
    if (level0 == "source") levels.front().lobe = lobe::AnyLobe::make("ggx,roughness=0");
    if (curve.listed_levels() == 0) curve_name = curve.text();
  } else {
    levels = {{finest, lobe}};
  }

  // The layout that a file has by default depends on the number of levels.
  const int all = static_cast<int>(levels.size());
  shape = parse_map_shape_for(out, to, all);
  check_output_size(finest, *shape, write);
  check_output_levels(out, *shape, finest, all, write);
  check_output(out, *shape, write);

  notes.lobe = lobe.has_roughness() ? lobe.name() : lobe.spec();
  notes.curve = curve_name;
  notes.software = std::string("welkin ") + WELKIN_VERSION;
  if (!lobe.has_roughness()) return;
  for (const PrefilterLevel& level : levels) notes.roughness.push_back(*roughness_of(level.lobe));
}

}  // namespace welkin::cli
