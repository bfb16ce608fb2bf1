#include <fmt/core.h>

#include <chrono>
#include <cmath>
#include <memory>

#include "bake_levels.h"
#include "bake_report.h"
#include "command.h"
#include "progress.h"
#include "welkin/base/number_text.h"
#include "welkin/map/adjust.h"
#include "welkin/map/borders.h"
#include "welkin/map/convention.h"
#include "welkin/prefilter/source_faults.h"

namespace welkin::cli {
namespace {

struct Bake {
  std::string in, out, tolerance = "0.1%", normalisation = "average", filter = "auto", format, rotation,
                       convention, verify;
  BakeLevels made;
  ReadFlags read;
  WriteFlags write;
  double exposure = 0;
  bool sanitize = false, json = false;

  void run();
  PrefilterOptions parse_options() const;
  WriteMapOptions parse_write();
  Map read_source() const;
  void check_source(Map& source) const;
};

/// Seconds since the last call, or since it was made.
class Clock {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return seconds;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// `0.001`, `0.1%` or `0.1 %`.
double parse_tolerance(const std::string& text) {
  std::string number = text;
  double unit = 1;
  if (!number.empty() && number.back() == '%') {
    unit = 0.01;
    number.pop_back();
    if (!number.empty() && number.back() == ' ') number.pop_back();
  }
  const std::optional<double> value = parse_number(number);
  if (!value || !(*value * unit >= 1e-6 && *value * unit <= 0.1)) {
    throw UsageError(
        fmt::format("--tolerance: '{}' is not in {}…{}: write 0.001 or 0.1%", printable(text), 1e-6, 0.1));
  }
  return *value * unit;
}

PrefilterOptions Bake::parse_options() const {
  PrefilterOptions options;
  options.tolerance = parse_tolerance(tolerance);
  options.scale = normalisation == "integral" ? LobeScale::integral : LobeScale::average;
  options.mirror_filter = parse_option("--filter", [&] { return filter_from_name(filter); });
  return options;
}

/// Texels as graphics cards name them.
WriteMapOptions Bake::parse_write() {
  if (!format.empty()) {
    if (!write.type.empty()) throw UsageError("--format: --type says the same in other words: give one");
    write.type = format == "rgba32f" ? "float" : format == "rgba16f" ? "half" : format;
  }
  return write.parse();
}

Map without_alpha(Map map) {
  const std::vector<std::string> rgba{"R", "G", "B", "A"};
  if (map.channel_names != rgba) return map;
  Map rgb(map.parameterization, map.width(), map.height(), 3);
  rgb.orientation = map.orientation;
  for (int chart = 0; chart < map.charts(); ++chart) {
    for (int y = 0; y < map.height(); ++y) {
      const float* from = map.level.chart(chart).row(y);
      float* to = rgb.level.chart(chart).row(y);
      for (int x = 0; x < map.width(); ++x) std::copy_n(from + 4 * x, 3, to + 3 * x);
    }
  }
  fill_borders(rgb);
  return rgb;
}

Map Bake::read_source() const {
  MapReader reader = read.open(in);
  Map source = reader.read();
  // Alpha is no light, unless it's asked for.
  return read.channels.empty() ? without_alpha(std::move(source)) : std::move(source);
}

void Bake::check_source(Map& source) const {
  if (sanitize) {
    const std::uint64_t mended = welkin::sanitize(source);
    if (mended > 0) fill_borders(source);
    tell(fmt::format("welkin: {}: {} texels with NaN or infinite values mended\n", in, mended));
  }
  const SourceFaults faults = faults_of(source);
  if (faults.not_finite > 0) {
    throw Error(fmt::format("{}: {} texels have NaN or infinite values; --sanitize replaces them", in,
                            faults.not_finite));
  }
  if (faults.excessive > 0) {
    throw Error(fmt::format("{}: {} texels have values of over {:g}, too large to filter", in,
                            faults.excessive, kMostRadiance));
  }
  if (faults.negative > 0) {
    tell(fmt::format("welkin: {}: {} texels have negative values, and are filtered with them\n", in,
                     faults.negative));
  }
  if (!source.parameterization.whole_world()) {
    tell(fmt::format("welkin: {}: shows {:.1f} % of the sphere; the rest counts as black\n", in,
                     100 * source.parameterization.coverage() / (4 * kPi)));
  }
}

void Bake::run() {
  // Everything that can be wrong with the request, before any file is touched.
  read.parse();
  const WriteMapOptions write_options = parse_write();
  PrefilterOptions options = parse_options();
  Matrix3 turn, orientation;
  if (!rotation.empty()) turn = parse_rotation("--rotate", rotation);
  made.parse(out, write);
  const sphere::AnyParameterization& target = made.shape->parameterization;
  if (!convention.empty()) {
    orientation = parse_option("--convention",
                               [&] { return orientation_for(convention_from_name(convention), target); });
  }
  // What was seen along d is seen along turn·d, where the file's own axes are told apart.
  options.orientation = orientation * turn;
  made.notes.normalisation = options.scale == LobeScale::integral ? "integral" : "radiance";

  BakeReport report{in, out, &made, options, {}, {}};
  Clock clock;
  Map source = read_source();
  const PrefilterShape shape{source.parameterization, {source.width(), source.height()}, source.channels()};
  if (!verify.empty()) check_verifiable(shape);
  check_source(source);
  report.read_seconds = clock.lap();
  const PrefilterPlan plan(shape, target, made.levels, options);
  report.methods = plan.methods();
  report.plan_seconds = clock.lap();
  Chain chain{plan.run(source, progress_monitor("bake")), made.notes};
  end_progress();
  report.compute_seconds = clock.lap();

  if (!verify.empty()) {
    std::vector<lobe::AnyLobe> lobes;
    for (const PrefilterLevel& level : made.levels) lobes.push_back(level.lobe);
    VerifyOptions verify_options;
    verify_options.prefilter = options;
    verify_options.random_texels = std::stoi(verify);
    verify_options.monitor = progress_monitor("verify");
    report.verification = verify_prefilter(source, chain.levels, lobes, verify_options);
    end_progress();
    report.verify_seconds = clock.lap();
  }
  for (Map& level : chain.levels) {
    level.orientation = orientation;
    if (exposure != 0) scale(level, static_cast<float>(std::exp2(exposure)));
    if (write.border > 0) fill_borders(level);
  }
  report_losses(out, write_chain(out, chain, made.shape->layout, write_options));
  report.write_seconds = clock.lap();
  json ? report.print_json() : report.print();
  report.report_misses();
}

}  // namespace

void add_bake(CLI::App& app) {
  auto bake = std::make_shared<Bake>();
  CLI::App* command =
      app.add_subcommand("bake", "Filter a map with a lobe, for lighting: a chain of levels, or one map");
  command->add_option("IN", bake->in, "Map to read; %s in the name stands for a face's name (px, nx…)")
      ->required();
  command
      ->add_option("OUT", bake->out,
                   "File to write; its extension names the format: ktx2 or exr for a chain, any for one map")
      ->required();
  bake->made.add(*command);
  command
      ->add_option("--tolerance", bake->tolerance,
                   "Relative RMS error to aim for at every level, 0.000001 to 0.1; or in percent, 0.1%")
      ->capture_default_str();
  command
      ->add_flag("--verify{64}", bake->verify,
                 "Compare N random texels of each level, and the brightest, with brute force, and measure "
                 "energy; --verify alone: 64")
      ->type_name("[=N]")
      ->check(CLI::Range(1, 1000000));
  command->add_option("--format", bake->format, "Stored texels: rgba32f, rgba16f, rgb9e5, r11g11b10")
      ->check(CLI::IsMember({"rgba32f", "rgba16f", "rgb9e5", "r11g11b10"}));
  command
      ->add_option("--normalisation", bake->normalisation,
                   "average: a constant map stays as it is; integral: times the lobe's integral, of lambert "
                   "the irradiance")
      ->check(CLI::IsMember({"average", "integral"}))
      ->capture_default_str();
  command
      ->add_option("--filter", bake->filter,
                   "How a level of roughness 0 reads the source: auto (antialiased), nearest, bilinear, "
                   "bicubic, lanczos")
      ->capture_default_str();
  command->add_option(
      "--rotate", bake->rotation,
      "Turn the world: yaw,pitch,roll in degrees, a quaternion w,x,y,z, or nine matrix entries");
  command->add_option("--convention,--to-convention", bake->convention,
                      "World of the output: three.js, blender… (`welkin list conventions`)");
  command->add_option("--exposure", bake->exposure, "Brighten by this many stops")->check(finite_number());
  command->add_flag("--sanitize", bake->sanitize,
                    "Replace NaN and infinite values by their neighbours' mean");
  command->add_flag("--json", bake->json, "Machine-readable, on standard output");
  bake->read.add(*command);
  bake->read.add_level(*command, "Level of the input to take. Default: the finest");
  bake->write.add(*command);
  command->callback([bake] { bake->run(); });
}

}  // namespace welkin::cli
