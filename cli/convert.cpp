#include <fmt/core.h>

#include <cmath>
#include <memory>
#include <optional>

#include <nlohmann/json.hpp>

#include "command.h"
#include "convert_coefficients.h"
#include "convert_curve.h"
#include "energy_report.h"
#include "json_text.h"
#include "progress.h"
#include "sanitize_flags.h"
#include "welkin/filter/resample.h"
#include "welkin/harmonics/coefficients_file.h"
#include "welkin/harmonics/file_irradiance.h"
#include "welkin/map/adjust.h"
#include "welkin/map_file/kept_convention.h"
#include "welkin/map_file/write_resampled.h"
#include "welkin/measure/energy.h"
#include "welkin/sphere/convention.h"

namespace welkin::cli {
namespace {

using nlohmann::ordered_json;

/// A filter that changed the energy by more is told.
constexpr double kToldChange = 0.01;
/// `--verify` fails where the energy of the whole changed by more.
constexpr double kVerifiedChange = 1e-3;

/// For levels that are means of a finer one.
ResampleOptions of_means(ResampleOptions options) {
  options.filter = Filter::automatic;
  return options;
}

struct Convert {
  std::string in, out, to, size, filter = "auto", rotation, convention, fill, format;
  CurveFlags curve;
  ReadFlags read;
  WriteFlags write;
  SanitizeFlags repair;
  double exposure = 0, scale = 1;
  bool allow_ringing = false, verify = false, json = false;

  void run() const;
  void run_of_coefficients(const Command& command) const {
    check_coefficients_options(command);
    CoefficientsToMap{in, out, to, size, rotation, convention, scale * std::exp2(exposure), write}.run();
  }
  /// How many of the input's levels are converted.
  int levels_for(const MapFileInfo& info) const;
  /// How many of them to write with charts of that size, and whether as means of level 0.
  struct LevelsToWrite {
    int count;
    bool remade;
  };
  LevelsToWrite levels_to_write(const MapFileInfo& info, int levels, const MapShape& shape,
                                ChartSize finest) const;
  /// Of level 0.
  ChartSize size_for(const Map& source, const MapShape& shape) const;
  /// Whether the output shows the part of the world that the input shows, and so is turned as that is.
  bool keeps_orientation(const MapFileInfo& info) const;
  /// Of the output: as asked, else the input's, which is told; empty: none.
  std::string convention_for(const MapFileInfo& info, const sphere::AnyParameterization& to) const;
  float factor() const { return static_cast<float>(scale * std::exp2(exposure)); }
  Map converted(const Map& source, const MapFrame& frame, const ResampleOptions& options) const;
  /// Warns of an interpolating filter that changed the energy.
  void tell_change(const EnergyComparison& energy) const;
  /// What was written.
  struct Written {
    MapShape shape;
    Matrix3 orientation, rotation;
    io::WriteReport report;
  };
  /// Reads it and reports the energy of each level and its source. Throws where it isn't kept.
  void verify_energy(std::vector<Map>& sources, const Written& what) const;
};

void Convert::run() const {
  // Everything that can be wrong with the request, before any file is touched.
  read.parse();
  WriteMapOptions write_options = write.parse();
  repair.parse();
  check_extension(out);
  if (json && !verify) throw UsageError("--json: is the report of --verify, which is not asked for");
  ResampleOptions options;
  options.filter = parse_option("--filter", [&] { return filter_from_name(filter); });
  options.allow_ringing = allow_ringing;
  options.borders = write.border > 0;
  if (!rotation.empty()) options.rotation = parse_rotation("--rotate", rotation);
  if (!fill.empty()) {
    for (double value : parse_numbers("--fill", fill)) options.fill.push_back(static_cast<float>(value));
  }
  std::optional<MapShape> shape;
  if (!to.empty()) shape = parse_option("--to", [&] { return parse_map_shape_for(out, to); });
  if (!convention.empty()) parse_option("--to-convention", [&] { return convention_from_name(convention); });
  curve.parse(out, read);
  if (shape) check_output(out, *shape, write);
  if (shape && !size.empty()) parse_chart_size("--size", size, shape->parameterization);

  MapReader reader = read.open(in);
  MapFileInfo info = reader.info();
  std::vector<Map> remixed;
  if (curve.asked()) remixed = curve.levels(reader, in, out, info);
  const int first = read.level.value_or(0);
  int levels = levels_for(info);
  shape = to.empty() ? shape_for_copy(info, out, levels) : parse_map_shape_for(out, to, levels);
  write_options.convention = convention_for(info, shape->parameterization);
  fit_to_convention(out, write_options.convention, *shape);
  if (!read.level && levels < levels_of(info)) {
    print_message(fmt::format("welkin: {}: holds level 0 of the {} of {}; --level takes another\n", out,
                              levels_of(info), in));
  }

  const Matrix3 orientation =
      write_options.convention.empty() && keeps_orientation(info) ? info.orientation
      : write_options.convention.empty()
          ? Matrix3{}
          : orientation_for(convention_from_name(write_options.convention), shape->parameterization);
  Chain chain;
  chain.notes = levels == 1 ? info.notes.of_level(first) : info.notes;
  ChartSize finest;
  io::WriteReport report;
  SanitizeReport repaired;
  SanitizeOptions repairs;
  if (repair.any())
    repairs = repair.parse(largest_value(out, write_options.image.type, static_cast<double>(factor())));
  repairs.negative_infinite = holds_negative(out, write_options.image.type);
  const bool interpolates = options.filter != Filter::automatic;
  std::vector<Map> sources;
  bool remade = false;
  std::optional<Map> remade_from;
  options.monitor = progress_monitor("convert");
  for (int level = 0; level < levels; ++level) {
    if (remade_from) {
      Map target = converted(*remade_from, {shape->parameterization, chain_size(finest, level), orientation},
                             of_means(options));
      if (factor() != 1) welkin::scale(target, factor());
      chain.levels.push_back(std::move(target));
      continue;
    }
    if (levels > 1 && remixed.empty()) reader.set_level(level);
    Map source = remixed.empty() ? reader.read() : std::move(remixed[static_cast<std::size_t>(level)]);
    if (level == 0) {
      check_output(out, *shape, write);
      if (options.fill.size() > static_cast<std::size_t>(source.channels())) {
        throw UsageError(fmt::format("--fill: {} values, but {} has {} channels", options.fill.size(), in,
                                     source.channels()));
      }
      options.fill.resize(std::min(options.fill.size(), static_cast<std::size_t>(source.channels())));
      finest = size_for(source, *shape);
      check_output_size(finest, *shape, write);
      const LevelsToWrite written = levels_to_write(info, levels, *shape, finest);
      levels = written.count;
      chain.notes.roughness.resize(std::min(chain.notes.roughness.size(), static_cast<std::size_t>(levels)));
      check_output_levels(out, *shape, finest, levels, write);
      if (write_options.convention.empty() && keeps_orientation(info) &&
          !io::capabilities_for(out).attributes) {
        print_message(fmt::format(
            "welkin: {}: is turned as the input is, which the file cannot say; --to latlong turns it to the "
            "native world\n",
            out));
      }
      remade = written.remade;
    }
    fit_channels_to(source, out, write_options, level > 0);
    if (repair.any()) {
      const SanitizeReport done = sanitize(source, repairs);
      repaired.filled += done.filled;
      repaired.infinite += done.infinite;
      repaired.clamped += done.clamped;
    }
    const EnergyOptions energy_options{.rotation = options.rotation,
                                       .monitor = without_progress(options.monitor)};
    if (levels == 1) {
      // Made when it is written.
      WriteResampledOptions how{options, orientation, factor(), chain.notes, write_options};
      std::optional<EnergyMeter> meter;
      if (interpolates) {
        meter.emplace(source, MapFrame(shape->parameterization, finest, orientation), source.channel_names,
                      energy_options);
        how.made = [&meter](int chart, int y, ImageView<const float> rows) { meter->add(chart, y, rows); };
      }
      report = write_resampled(out, source, *shape, finest, how);
      if (meter) tell_change(meter->comparison());
    } else {
      Map target =
          converted(source, {shape->parameterization, chain_size(finest, level), orientation}, options);
      if (interpolates) tell_change(compare_energy(source, target, energy_options));
      if (factor() != 1) welkin::scale(target, factor());
      chain.levels.push_back(std::move(target));
    }
    if (verify) sources.push_back(remade ? source.clone() : std::move(source));
    if (remade) remade_from = std::move(source);
  }
  end_progress();
  if (repair.any()) repair.print(in, repaired, repairs);
  if (const std::string basis = irradiance_of(out); !basis.empty() && levels > 1) {
    const std::string& lobe = chain.notes.lobe;
    const auto filtered = lobe.empty() ? lobe::AnyLobe::mirror() : lobe::AnyLobe::make(lobe);
    const double roughness = chain.notes.roughness_of(0).value_or(0);
    write_options.image.irradiance =
        harmonics::file_irradiance(chain.levels.front(), basis, orientation,
                                   filtered.has_roughness() ? filtered.with_roughness(roughness) : filtered);
  }
  if (levels > 1) report = write_chain(out, chain, shape->layout, write_options);
  report_losses(out, report);
  if (verify) verify_energy(sources, {*shape, orientation, options.rotation, report});
}

void Convert::tell_change(const EnergyComparison& energy) const {
  const double whole = energy.change_of_whole(), lights = energy.change_of_lights();
  if (!(std::max(whole, lights) > kToldChange)) return;
  end_progress();
  std::string text =
      fmt::format("{} changed the energy: of the whole by {}", filter, change_text(energy.whole.ratio));
  for (const LightChange& each : energy.lights) {
    if (!(std::fabs(each.change.ratio - 1) > kToldChange)) continue;
    text += fmt::format(", of the light along {} by {}", direction_text(each.light.direction),
                        change_text(each.change.ratio));
  }
  print_message(fmt::format("welkin: {}: {}; --filter auto keeps it\n", out, text));
}

void Convert::verify_energy(std::vector<Map>& sources, const Written& what) const {
  ReadMapOptions read_options;
  read_options.shape = what.shape.text();
  read_options.faces = write.faces;
  read_options.image.colour = write.parse().image.colour;
  MapReader written(out, read_options);
  if (written.info().border != write.border) {
    // Where the file doesn't say so.
    read_options.border = write.border - written.info().border;
    written = MapReader(out, read_options);
  }
  written.set_orientation(what.orientation);
  ordered_json all{{"in", in}, {"out", out}};
  const std::uint64_t clipped = what.report.above + what.report.below + what.report.not_finite;
  all["clipped_values"] = clipped;
  double changed = 0;
  for (std::size_t level = 0; level < sources.size(); ++level) {
    if (factor() != 1) welkin::scale(sources[level], factor());
    const EnergyComparison energy = compare_energy(
        sources[level], sources.size() == 1 ? written.read() : written.read(static_cast<int>(level)),
        {.rotation = what.rotation});
    changed = std::max(changed, energy.change_of_whole());
    if (json) {
      if (sources.size() == 1) all["energy"] = json_of(energy);
      if (sources.size() > 1) all["levels"].push_back({{"level", level}, {"energy", json_of(energy)}});
    } else {
      if (sources.size() > 1) fmt::print("level {}\n", level);
      print_energy(energy);
    }
  }
  if (json) print_json_text(all);
  if (!json) fmt::print("{} values clipped\n", clipped);
  if (changed <= kVerifiedChange) return;
  throw Error(ErrorKind::mismatch, out,
              fmt::format("the energy differs from that of {} by {:.3g} %, more than {:g} %{}", in,
                          100 * changed, 100 * kVerifiedChange,
                          clipped > 0 ? fmt::format("; {} values were clipped", clipped) : std::string()));
}

int Convert::levels_for(const MapFileInfo& info) const {
  if (read.level || !holds_levels(out)) return 1;
  // Mere averages of the finest level can be made again for another shape; filtered levels can't.
  const bool same_shape = to.empty() || for_chart_size(parse_map_shape(to), info.chart).parameterization ==
                                            info.shape->parameterization;
  return !info.notes.empty() || (same_shape && size.empty()) ? levels_of(info) : 1;
}

Convert::LevelsToWrite Convert::levels_to_write(const MapFileInfo& info, int levels, const MapShape& shape,
                                                ChartSize finest) const {
  const auto same = [](ChartSize a, ChartSize b) { return a.width == b.width && a.height == b.height; };
  bool halved = true;
  for (int level = 1; level < levels; ++level)
    halved = halved && same(info.levels[static_cast<std::size_t>(level)], chain_size(info.levels[0], level));
  if (halved || !size.empty()) return {levels, false};
  // As many as the file takes, of levels whose sizes are rounded down.
  int count = std::min(levels, max_levels(finest));
  const bool remade = info.notes.empty();
  const auto fit = [&] {
    try {
      check_chain(out, shape, finest, count, write.parse());
      return true;
    } catch (const Error&) {
      return false;
    }
  };
  while (remade && count > 1 && !fit()) --count;
  print_warning(in, fmt::format("the sizes of its levels are rounded up: {} {} of size rounded down, {}",
                                count, count == 1 ? "level is written" : "levels are written",
                                remade ? "means of level 0" : "each resampled from its own"));
  return {count, remade};
}

ChartSize Convert::size_for(const Map& source, const MapShape& shape) const {
  if (!size.empty()) return parse_chart_size("--size", size, shape.parameterization);
  // A change of format, layout or faces alone keeps the size, even where it isn't square.
  const ChartSize same{source.width(), source.height()};
  if (for_chart_size(shape, same).parameterization == source.parameterization) return same;
  return default_chart_size(source, shape.parameterization);
}

bool Convert::keeps_orientation(const MapFileInfo& info) const {
  return to.empty() && convention.empty() && read.convention.empty() && rotation.empty() &&
         !info.shape->parameterization.whole_world() && !(info.orientation == Matrix3{});
}

std::string Convert::convention_for(const MapFileInfo& info, const sphere::AnyParameterization& to) const {
  if (!convention.empty() || !read.convention.empty()) return convention;
  if (const std::optional<KeptConvention> kept = kept_convention(info, to)) {
    const bool declares = io::capabilities_for(out).attributes;
    print_warning(out, fmt::format("is in the convention {}, as {} is{}; --convention native turns it",
                                   kept->name, in, declares ? "" : ", which the file cannot say"));
    return kept->name;
  }
  if (declares_convention(info))
    print_warning(out,
                  fmt::format("is in the native world; {} is not, and does not say by name in which one, "
                              "--convention does",
                              in));
  return {};
}

Map Convert::converted(const Map& source, const MapFrame& frame, const ResampleOptions& options) const {
  Map target(frame.parameterization, frame.size.width, frame.size.height, source.channels());
  target.channel_names = source.channel_names;
  target.orientation = frame.orientation;
  resample(source, target, options);
  return target;
}

}  // namespace

void add_convert(Command app) {
  auto convert = std::make_shared<Convert>();
  Command command =
      app.add_command("convert", "Convert a map between parameterizations, layouts and file formats");
  command
      .add_option("IN", convert->in,
                  "Map to read; %s in the name stands for a face's name (px, nx…); - is standard input; or "
                  "coefficients of harmonics: .json, .csv, .txt")
      .required();
  command
      .add_option("OUT", convert->out,
                  "Map to write; its extension names the format; - is standard output, see --format")
      .required();
  command.add_option("--to", convert->to,
                     "Parameterization of the output: NAME[:LAYOUT][,PARAMETER=VALUE]. Default: the input's");
  command.add_option(
      "--size", convert->size,
      "Size of a chart (a face) in texels: N across, or WxH. Default: as many texels as the input has");
  command.add_option("--filter", convert->filter, "auto (antialiased), nearest, bilinear, bicubic, lanczos")
      .show_default();
  command.add_option(
      "--rotate", convert->rotation,
      "Rotate the world: yaw,pitch,roll in degrees, a quaternion w,x,y,z, or nine matrix entries");
  command.add_option("--convention,--to-convention", convert->convention,
                     "World of the output: three.js, blender… (`welkin list conventions`)");
  convert->curve.add(command);
  command.add_option("--exposure", convert->exposure, "Brighten by this many stops").finite();
  command.add_option("--scale", convert->scale, "Multiply radiance").finite();
  command.add_option(
      "--fill", convert->fill,
      "Value, one per channel, for directions that the input doesn't show and texels outside the "
      "output's discs and triangles. Default: 0");
  command.add_flag("--allow-ringing", convert->allow_ringing,
                   "Leave the overshoot of bicubic and lanczos beside bright lights unclamped");
  convert->repair.add(command);
  command.add_flag("--verify", convert->verify,
                   "Read what was written, and print the energy before and after, of the whole and of the "
                   "brightest lights; exit with status 1 when that of the whole changed by over 0.1 %");
  command.add_flag("--json", convert->json, "With --verify: machine-readable, on standard output");
  convert->read.add(command);
  convert->read.add_level(command,
                          "Level of the input to take. Default: all, where the output holds levels and they "
                          "are filtered or keep their shape");
  convert->write.add(command);
  add_format(command, convert->format);
  command.callback([convert, command] {
    if (convert->verify && convert->out == "-")
      throw UsageError(
          "--verify: reads what was written, which standard output does not allow: write a file");
    convert->out = output_path(convert->out, convert->format);
    if (harmonics::is_coefficients_path(convert->in)) return convert->run_of_coefficients(command);
    convert->in = input_path(convert->in);
    convert->run();
  });
}

}  // namespace welkin::cli
