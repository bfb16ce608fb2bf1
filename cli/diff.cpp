#include <fmt/core.h>

#include <cmath>
#include <memory>
#include <optional>

#include <nlohmann/json.hpp>

#include "command.h"
#include "energy_report.h"
#include "json_text.h"
#include "welkin/base/error.h"
#include "welkin/measure/compare.h"

namespace welkin::cli {
namespace {

using nlohmann::ordered_json;

struct Diff {
  std::string a, b, filter = "bilinear", heat, from_b, format;
  ReadFlags read;
  double peak = 0, fail_above = -1;
  std::optional<int> level;
  bool json = false;

  void run() const;
  void compare_maps(const Map& reference, const Map& other, const CompareOptions& options) const;
  /// Level by level.
  void compare_chains(MapReader& reference, MapReader& other, const CompareOptions& options) const;
  /// Throws when the error is above fail_above.
  void check_error(const Comparison& result, const std::string& where) const;
};

ordered_json json_of(const ErrorMeasures& e) {
  const auto direction = [](const Vec3d& d) { return ordered_json{d.x, d.y, d.z}; };
  return {{"name", e.name},
          {"relative_rmse", e.relative_rmse},
          {"rmse", e.rmse},
          {"rmsle", e.rmsle},
          {"mean_absolute", e.mean_absolute},
          {"max", e.maximum_absolute},
          {"max_direction", direction(e.maximum_absolute_direction)},
          {"max_relative", e.maximum_relative},
          {"max_relative_direction", direction(e.maximum_relative_direction)},
          {"psnr", std::isfinite(e.psnr) ? ordered_json(e.psnr) : ordered_json(nullptr)},
          {"mean_a", e.mean_a},
          {"mean_b", e.mean_b},
          {"energy_ratio", e.energy_ratio}};
}

void print(const ErrorMeasures& e) {
  fmt::print(
      "{:<8} rel. RMSE {:.6g}   RMSE {:.6g}   RMSLE {:.6g}   max {:.6g} along {:.3f},{:.3f},{:.3f}   PSNR "
      "{:.2f} "
      "dB   energy {:.6f}\n",
      e.name, e.relative_rmse, e.rmse, e.rmsle, e.maximum_absolute, e.maximum_absolute_direction.x,
      e.maximum_absolute_direction.y, e.maximum_absolute_direction.z, e.psnr, e.energy_ratio);
}

void print_footer(const Comparison& result) {
  fmt::print("{} texels over {:.4f} sr compared {}{}; PSNR is relative to {:g}\n", result.texels,
             result.solid_angle, result.texel_by_texel ? "one by one" : "at the finer map's texels",
             result.skipped > 0 ? fmt::format(", {} skipped (NaN or infinite)", result.skipped) : "",
             result.peak);
}

void add_json(ordered_json& report, const Comparison& result) {
  report["all"] = json_of(result.all);
  for (const ErrorMeasures& channel : result.channels) report["channels"].push_back(json_of(channel));
  report["peak"] = result.peak;
  report["texel_by_texel"] = result.texel_by_texel;
  report["texels"] = result.texels;
  report["solid_angle"] = result.solid_angle;
  report["skipped"] = result.skipped;
  report["energy"] = cli::json_of(result.energy);
}

void Diff::check_error(const Comparison& result, const std::string& where) const {
  if (fail_above < 0 || result.all.relative_rmse <= fail_above) return;
  throw Error(ErrorKind::mismatch, fmt::format("{} and {} differ{}: relative RMSE {:.6g} is above {:g}", a, b,
                                               where, result.all.relative_rmse, fail_above));
}

void Diff::compare_maps(const Map& reference, const Map& other, const CompareOptions& options) const {
  std::optional<Map> picture;
  if (!heat.empty()) {
    picture.emplace(sphere::AnyParameterization::make("latlong"), options.heat_width, options.heat_width / 2,
                    3);
  }
  const Comparison result = compare(reference, other, options, picture ? &*picture : nullptr);
  end_progress();
  if (picture) write_map(heat, *picture, layouts_of(picture->parameterization).front());
  if (json) {
    ordered_json report{{"a", a}, {"b", b}};
    add_json(report, result);
    print_json_text(report);
  } else {
    for (const ErrorMeasures& channel : result.channels) print(channel);
    print(result.all);
    print_footer(result);
    print_energy(result.energy);
  }
  check_error(result, "");
}

void Diff::compare_chains(MapReader& reference, MapReader& other, const CompareOptions& options) const {
  const int levels_a = levels_of(reference.info()), levels_b = levels_of(other.info());
  ordered_json report{{"a", a}, {"b", b}, {"levels_a", levels_a}, {"levels_b", levels_b}};
  std::vector<Comparison> results;
  for (int level = 0; level < std::min(levels_a, levels_b); ++level) {
    reference.set_level(level);
    other.set_level(level);
    results.push_back(compare(reference.read(), other.read(), options));
    ErrorMeasures named = results.back().all;
    named.name = fmt::format("level {}", level);
    if (!json) print(named);
    ordered_json entry{{"level", level}};
    add_json(entry, results.back());
    report["levels"].push_back(std::move(entry));
  }
  end_progress();
  if (json) print_json_text(report);
  if (!json && levels_a != levels_b)
    fmt::print("{} has {} levels, {} has {}: the others are not compared\n", a, levels_a, b, levels_b);
  for (std::size_t level = 0; level < results.size(); ++level) {
    check_error(results[level], fmt::format(" at level {}", level));
  }
}

void Diff::run() const {
  read.parse();
  CompareOptions options;
  options.filter = parse_option("--filter", [&] { return filter_from_name(filter); });
  options.peak = peak;
  ReadFlags read_b = read;
  if (!from_b.empty()) {
    parse_option("--from-b", [&] { return parse_map_shape(from_b); });
    read_b.from = from_b;
  }
  if (!heat.empty()) check_output(heat, parse_map_shape("latlong"));
  MapReader reference = read.open(a), other = read_b.open(b);
  const bool chains = levels_of(reference.info()) > 1 && levels_of(other.info()) > 1;
  if (level) {
    // A file with one level is compared with the other's level as it is.
    const bool any = levels_of(reference.info()) > 1 || levels_of(other.info()) > 1;
    for (MapReader* each : {&reference, &other}) {
      if (!any || levels_of(each->info()) > 1) parse_option("--level", [&] { each->set_level(*level); });
    }
  }
  options.monitor = progress_monitor("diff");
  if (level || !chains) return compare_maps(reference.read(), other.read(), options);
  if (!heat.empty()) throw UsageError("--heat: shows one level of these files: name it with --level");
  compare_chains(reference, other, options);
}

}  // namespace

void add_diff(Command app) {
  auto diff = std::make_shared<Diff>();
  Command command =
      app.add_command("diff", "Measure how B differs from A over the sphere, also across parameterizations");
  command.add_option("A", diff->a, "Reference map; - is standard input").required();
  command.add_option("B", diff->b, "Map to compare; - is standard input").required();
  command.add_option("--from-b", diff->from_b, "Parameterization of B, where it differs from --from");
  command
      .add_option("--filter", diff->filter,
                  "How the coarser map is read: nearest, bilinear, bicubic, lanczos")
      .show_default();
  command
      .add_option("--peak", diff->peak,
                  "What PSNR is relative to. Default: 1, or A's maximum where that is above 1")
      .finite(0);
  command.add_option(
      "--heat", diff->heat,
      "Write a picture of the relative error (lat-long, colour scale 1e-5 to 1); - is standard output, see "
      "--format");
  command
      .add_option("--fail-above", diff->fail_above, "Exit with status 1 when the relative RMSE is above this")
      .finite(0);
  command.add_flag("--json", diff->json, "Machine-readable, on standard output");
  diff->read.add(command);
  command
      .add_option(
          "--level", diff->level,
          "Level to compare, of both files or of the one that has several. Default: each that both have")
      .within(0, 20);
  add_format(command, diff->format);
  command.callback([diff] {
    if (diff->a == "-" && diff->b == "-")
      throw UsageError("-: standard input holds one file, not both A and B");
    diff->heat = output_path(diff->heat, diff->format);
    diff->a = input_path(diff->a);
    diff->b = input_path(diff->b);
    diff->run();
  });
}

}  // namespace welkin::cli
