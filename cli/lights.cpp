#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <span>

#include <nlohmann/json.hpp>

#include "command.h"
#include "json_text.h"
#include "lights_report.h"
#include "progress.h"
#include "sanitize_flags.h"
#include "welkin/base/listed.h"
#include "welkin/io/output_file.h"
#include "welkin/light/extract.h"
#include "welkin/light/light_text.h"
#include "welkin/light/region_lights.h"
#include "welkin/prefilter/source_faults.h"
#include "welkin/sphere/convention.h"

namespace welkin::cli {
namespace {

using nlohmann::ordered_json;

struct Lights {
  std::string in, out, method = "sources", residual, target, convention;
  std::optional<int> most;
  std::optional<double> above, sun_irradiance;
  double unit = 1;
  bool json = false;
  ReadFlags read;
  WriteFlags write;
  SanitizeFlags repair;

  void run();

 private:
  bool of_sources() const { return method == "sources"; }
  void check() const;
  /// None: JSON or the table.
  std::optional<LightFormat> format() const;
  ordered_json report(const LightSet& set, const Extraction* extraction, const Matrix3& world) const;
  void print(const LightSet& set, const Extraction* extraction, const Matrix3& world) const;
};

void write_text(const std::string& path, const std::string& text) {
  try {
    io::OutputFile file(path);
    file.write(std::as_bytes(std::span(text)));
    file.commit();
  } catch (const Error& error) {
    throw in_file(path, error);
  }
}

std::vector<std::string> format_names() {
  std::vector<std::string> names{"json"};
  for (const LightFormat& each : light_formats()) names.push_back(each.name);
  return names;
}

/// Tells what is assumed of what there is no light of.
void check_values(const Map& source, const std::string& in) {
  const SourceFaults faults = faults_of(source);
  if (faults.not_finite > 0) {
    throw Error(
        ErrorKind::bad_value, in,
        fmt::format("{} texels have NaN or infinite values; --sanitize repairs them", faults.not_finite));
  }
  if (faults.negative > 0) {
    print_warning(in,
                  fmt::format("{} texels have negative values, which count as they are", faults.negative));
  }
  if (!source.parameterization.whole_world()) {
    print_warning(in, fmt::format("shows {:.1f} % of the sphere; the rest is left out, in the mean too",
                                  100 * source.parameterization.coverage() / (4 * kPi)));
  }
}

void Lights::check() const {
  if (!of_sources()) {
    for (const auto& [option, given] : {std::pair{"--residual", !residual.empty()},
                                        {"--above", above.has_value()},
                                        {"--sun-irradiance", sun_irradiance.has_value()}}) {
      if (given) {
        throw UsageError(fmt::format("{}: is for --method sources; {} makes lights of all that the map has",
                                     option, method));
      }
    }
  }
  if (most && *most < 1 && !of_sources()) throw UsageError("--most: at least one light");
  if (json && !out.empty()) throw UsageError("--json: is for standard output; OUT's extension says .json");
  if (json && !target.empty() && target != "json") throw UsageError("--json: --for says another format");
}

std::optional<LightFormat> Lights::format() const {
  if (target == "json") return std::nullopt;
  if (!target.empty()) return light_format_from_name(target);
  if (out.empty()) return std::nullopt;
  std::string extension = std::filesystem::path(out).extension().string();
  if (!extension.empty()) extension.erase(0, 1);
  if (extension == "json") return std::nullopt;
  std::vector<std::string> known{".json"};
  for (const LightFormat& each : light_formats()) {
    if (each.extension == extension) return each;
    known.push_back("." + each.extension);
  }
  throw UsageError(fmt::format("{}: name the format with --for, or by the extension: {}", printable(out),
                               listed(known, ", ")));
}

ordered_json Lights::report(const LightSet& set, const Extraction* extraction, const Matrix3& world) const {
  ordered_json lights = ordered_json::array();
  for (std::size_t k = 0; k < set.lights.size(); ++k) lights.push_back(json_of(set, k, world));
  ordered_json report{{"in", in},
                      {"method", method},
                      {"convention", convention.empty() ? "native" : convention},
                      {"channels", set.channels},
                      {"lights", lights}};
  if (extraction != nullptr) {
    report["mean_luminance"] = extraction->mean;
    report["shown"] = extraction->shown;
    report["energy"] = by_channel(set, extraction->energy);
    report["residual_energy"] = by_channel(set, extraction->residual_energy);
  }
  return report;
}

void Lights::print(const LightSet& set, const Extraction* extraction, const Matrix3& world) const {
  print_lights(set, world);
  if (extraction == nullptr) return;
  if (set.lights.empty() && most == 0) {
    fmt::print("no light was asked for\n");
  } else if (set.lights.empty()) {
    fmt::print("no light is {:g} times as bright as the mean, {:.6g}\n",
               above.value_or(ExtractOptions{}.above), extraction->mean);
  }
  for (std::size_t c = 0; c < set.channels.size(); ++c) {
    const double all = extraction->energy[c], rest = extraction->residual_energy[c];
    fmt::print("energy {}: {:.6g} of {:.6g} in lights, {:.6g} left\n", printable(set.channels[c]), all - rest,
               all, rest);
  }
}

void Lights::run() {
  read.parse();
  check();
  const std::optional<LightFormat> text_format = format();
  const WriteMapOptions write_options = write.parse();
  const SanitizeOptions repairs = repair.parse(static_cast<double>(kMaxRadiance));
  Matrix3 world;
  if (!convention.empty())
    world = parse_option("--convention", [&] { return convention_from_name(convention); }).world;
  if (!residual.empty()) check_extension(residual);
  MapReader reader = read.open(in);
  std::optional<MapShape> shape;
  if (!residual.empty()) {
    shape = shape_for_copy(reader.info(), residual);
    check_output(residual, *shape, write);
  }
  Map source = reader.read();
  if (repair.any()) repair.print(in, sanitize(source, repairs), repairs);
  check_values(source, in);
  LightSet set;
  std::optional<Extraction> extraction;
  if (of_sources()) {
    ExtractOptions options;
    if (most) options.most = *most;
    if (above) options.above = *above;
    options.sun_irradiance = sun_irradiance;
    options.monitor = progress_monitor("lights");
    extraction.emplace(extract_lights(source, options));
    set = extraction->found;
  } else {
    RegionOptions options;
    options.method = method == "variance" ? RegionMethod::variance : RegionMethod::median_cut;
    if (most) options.count = *most;
    options.monitor = progress_monitor("lights");
    set = region_lights(source, options);
  }
  end_progress();
  const Extraction* found = extraction ? &*extraction : nullptr;
  const auto as_json = [&] { return json_text(report(set, found, world)); };
  if (!out.empty()) {
    write_text(out, text_format ? light_text(*text_format, set, unit) : as_json());
  }
  if (!residual.empty()) {
    fit_channels_to(extraction->residual, residual, write_options);
    report_losses(residual, write_map(residual, extraction->residual, shape->layout, write_options));
  }
  if (out.empty() && text_format) {
    fmt::print("{}", light_text(*text_format, set, unit));
  } else if (json || (out.empty() && target == "json")) {
    fmt::print("{}", as_json());
  } else {
    print(set, found, world);
  }
  warn_of_lights(in, set);
}

}  // namespace

void add_lights(Command app) {
  auto lights = std::make_shared<Lights>();
  Command command = app.add_command("lights", "Find a map's suns and lamps, or make lights of all of it");
  command
      .add_option("IN", lights->in,
                  "Map to read; %s in the name stands for a face's name; - is standard input")
      .required();
  command.add_option("OUT", lights->out,
                     "File to write: .json, .js (three.js), .gltf, .rs (Bevy), .py (Blender), .pbrt, .xml "
                     "(Mitsuba), .usda. Default: a table on standard output");
  command
      .add_option("--for", lights->target, "Format, whatever OUT is called; without OUT, on standard output")
      .one_of(format_names());
  command
      .add_option(
          "--method", lights->method,
          "sources: suns and lamps, taken out of the map; median-cut, variance: N lights that stand for "
          "all of it")
      .one_of({"sources", "median-cut", "variance"})
      .show_default();
  command
      .add_option("--most", lights->most,
                  "At most so many lights, the strongest. Default: 16; of the other methods 64")
      .within(0, 65536);
  command
      .add_option("--above", lights->above,
                  "Only lights whose peak is at least so many times the map's mean luminance. Default: 10")
      .finite(1.000001);
  command
      .add_option("--sun-irradiance", lights->sun_irradiance,
                  "Luminance of the strongest light's irradiance, to restore a clipped sun")
      .finite(1e-30);
  command.add_option("--residual", lights->residual,
                     "Map to write: what is left, smooth where lights were; its extension names the format");
  command
      .add_option("--unit", lights->unit,
                  "What 1 in the map stands for, in what is written for a program: cd/m², W/(m²·sr)")
      .finite(1e-30)
      .show_default();
  command.add_option("--convention", lights->convention,
                     "World of the directions in the table and in JSON: unity, blender… "
                     "(`welkin list conventions`)");
  command.add_flag("--json", lights->json, "Machine-readable, on standard output");
  lights->repair.add(command);
  lights->read.add(command);
  lights->read.add_level(command, "Level of the input to take. Default: the finest");
  lights->write.add(command);
  command.callback([lights] {
    lights->in = input_path(lights->in);
    lights->run();
  });
}

}  // namespace welkin::cli
