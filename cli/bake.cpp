#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <utility>

#include "bake_atlas.h"
#include "bake_frames.h"
#include "bake_levels.h"
#include "bake_report.h"
#include "bake_set.h"
#include "bake_source.h"
#include "bake_views.h"
#include "command.h"
#include "lights_report.h"
#include "progress.h"
#include "sanitize_flags.h"
#include "welkin/base/number_text.h"
#include "welkin/harmonics/file_irradiance.h"
#include "welkin/light/extract.h"
#include "welkin/map/adjust.h"
#include "welkin/prefilter/source_faults.h"
#include "welkin/sphere/convention.h"

namespace welkin::cli {
namespace {

struct Bake {
  std::string in, out, tolerance = "0.1%", normalisation = "average", filter = "auto", format;
  std::string rotation, convention, verify, atlas;
  BakeLevels made;
  BakeViews views;
  BakeSet set;
  Option tolerance_option;
  ReadFlags read;
  WriteFlags write;
  double exposure = 0;
  SanitizeFlags repair;
  FrameFlags frames;
  std::string request;  ///< request_of; of a set command_line
  bool json = false, extract_sun = false, to_stdout = false;

  void run();
  void run_set();
  /// Repairs that suit what is written to a file of that name.
  SanitizeOptions repairs_for(const std::string& path, const io::WriteOptions& written) const;
  PrefilterOptions parse_options() const;
  WriteMapOptions parse_write();
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

/// As graphics cards name them.
std::vector<std::string> texel_formats() {
  return {"rgba32f", "rgba16f", "rgb9e5", "r11g11b10", "bc6h", "uastc-hdr"};
}

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
  options.borders = false;  // filled before writing, where the file has them
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

SanitizeOptions Bake::repairs_for(const std::string& path, const io::WriteOptions& written) const {
  SanitizeOptions repairs = repair.parse(
      std::min(largest_value(path, written.type, std::exp2(exposure)), static_cast<double>(kMaxRadiance)));
  repairs.negative_infinite = holds_negative(path, written.type);
  return repairs;
}

void Bake::run_set() {
  read.parse();
  const WriteMapOptions write_options = parse_write();
  const PrefilterOptions prefilter = parse_options();
  if (!convention.empty()) parse_option("--convention", [&] { return convention_from_name(convention); });
  SetOptions options = set.parse(out, made, write.type, convention, write_options);
  options.tolerance = prefilter.tolerance;
  options.mirror_filter = prefilter.mirror_filter;
  options.exposure = std::exp2(exposure);
  if (!verify.empty()) options.verified_texels = std::stoi(verify);
  Matrix3 turn;
  if (!rotation.empty()) turn = parse_rotation("--rotate", rotation);
  Map source = read_bake_source(in, read, repair, repairs_for("x.ktx2", write_options.image));
  SetRequest told{request,
                  std::filesystem::path(in).filename().string(),
                  source.parameterization.spec(),
                  source.width(),
                  source.height(),
                  prefilter.tolerance,
                  {}};
  turn_world(source, turn);
  if (extract_sun) {
    if (source.channel_names == default_channel_names(4)) source = without_alpha(source);
    Extraction extraction = extract_lights(source, {.most = 1});
    source = std::move(extraction.residual);
    told.sun = brightened(std::move(extraction.found), std::exp2(exposure));
    warn_of_lights(in, *told.sun);
  }
  options.monitor = progress_monitor("bake");
  set.run(source, out, options, told, json);
}

void Bake::run() {
  // Everything that can be wrong with the request, before any file is touched.
  read.parse();
  const bool numbered = names_frames(in, out);
  if (!numbered) frames.check_unused();
  if (numbered && !verify.empty())
    throw UsageError("--verify: is for one map; of frames, --held-out measures the error of interpolating");
  if (numbered && extract_sun)
    throw UsageError(
        "--extract-sun: is for one map; a sun of its own in every frame would jump between them");
  WriteMapOptions write_options = parse_write();
  write_options.convention = convention;
  // What a stack is made with by default: see ViewBakeOptions.
  if (views.makes_stack() && !tolerance_option.given()) tolerance = "0.5%";
  const PrefilterOptions prefilter = parse_options();
  Matrix3 turn;
  if (!rotation.empty()) turn = parse_rotation("--rotate", rotation);
  const bool of_views = views.asked();
  if (of_views && !verify.empty()) throw UsageError("--verify: compares with a lobe; --brdf has none");
  if (of_views && normalisation == "integral")
    throw UsageError("--normalisation: --brdf makes averages, with the albedo beside them");
  if (of_views && extract_sun)
    throw UsageError("--extract-sun: is not told with --brdf; bake what `welkin lights --residual` leaves");
  if (of_views && numbered) throw UsageError("--brdf: is for one map, not for frames");
  if (of_views) views.prepare(made, out);
  if (!atlas.empty())
    return bake_atlas({in, out, write_options, prefilter, turn, std::exp2(exposure)}, made, read, repair);
  made.parse(out, write);
  BakeOptions& options = made.options;
  options.prefilter = prefilter;
  options.prefilter.borders = write.border > 0;
  // Channels that were named are all wanted.
  options.keep_alpha = !read.channels.empty();
  if (!convention.empty()) parse_option("--convention", [&] { return convention_from_name(convention); });
  fit_to_convention(out, convention, *made.shape);
  if (!convention.empty()) {
    options.target = made.shape->parameterization;
    options.prefilter.orientation = orientation_for(convention_from_name(convention), options.target);
  }

  const SanitizeOptions repairs = repairs_for(out, write_options.image);

  if (numbered) {
    return bake_numbered(frames, {in, out, made, read, repair, repairs, write_options, turn,
                                  std::exp2(exposure), request, json});
  }
  BakeReport report{in, out, &made, bake_notes(options), {}, {}, {}, {}};
  Clock clock;
  Map source = read_bake_source(in, read, repair, repairs);
  turn_world(source, turn);
  if (!options.keep_alpha && source.channel_names == default_channel_names(4)) source = without_alpha(source);
  fit_channels_to(source, out, write_options);
  if (extract_sun) {
    Extraction extraction = extract_lights(source, {.most = 1});
    source = std::move(extraction.residual);
    report.sun = brightened(std::move(extraction.found), std::exp2(exposure));
  }
  const PrefilterShape shape{source.parameterization, {source.width(), source.height()}, source.channels()};
  if (!verify.empty()) check_verifiable(shape);
  report.read_seconds = clock.lap();
  if (of_views && exposure != 0) scale(source, static_cast<float>(std::exp2(exposure)));
  if (of_views) return views.run(source, made, in, out, write_options, json);
  const BakePlan plan(shape, options);
  report.methods = plan.methods();
  report.plan_seconds = clock.lap();
  Chain chain = plan.run(source, progress_monitor("bake"));
  end_progress();
  report.compute_seconds = clock.lap();

  if (!verify.empty()) {
    VerifyOptions verify_options;
    verify_options.prefilter = options.prefilter;
    verify_options.random_texels = std::stoi(verify);
    verify_options.own_texels = options.method != BakeMethod::exact;
    verify_options.monitor = progress_monitor("verify");
    report.verification = verify_prefilter(source, chain.levels, made.levels, verify_options);
    end_progress();
    report.verify_seconds = clock.lap();
  }
  if (exposure != 0) {
    for (Map& level : chain.levels) scale(level, static_cast<float>(std::exp2(exposure)));
  }
  if (const std::string basis = irradiance_of(out); !basis.empty()) {
    write_options.image.irradiance = harmonics::file_irradiance(source, basis, options.prefilter.orientation);
    for (double& each : write_options.image.irradiance) each *= std::exp2(exposure);
  }
  report_losses(out, write_chain(out, chain, made.shape->layout, write_options));
  report.write_seconds = clock.lap();
  if (write_options.image.type && io::is_packed(*write_options.image.type) && !to_stdout)
    report.stored = stored_errors(chain, read_chain(out, as_written(chain, made.shape->text())));
  json ? report.print_json() : report.print();
  report.report_misses();
}

}  // namespace

void add_bake(Command app) {
  auto bake = std::make_shared<Bake>();
  Command command =
      app.add_command("bake", "Filter a map with a lobe, for lighting: a chain of levels, or one map");
  command
      .add_option(
          "IN", bake->in,
          "Map to read; %s in the name stands for a face's name (px, nx…), %04d or #### for the number of "
          "a frame; - is standard input")
      .required();
  command
      .add_option(
          "OUT", bake->out,
          "File to write; its extension names the format: ktx2 or exr for a chain, any for one map; - is "
          "standard output, see --format; of frames, a name with %04d or #### too")
      .required();
  bake->made.add(command);
  bake->views.add(command);
  bake->set.add(command);
  bake->tolerance_option =
      command
          .add_option("--tolerance", bake->tolerance,
                      "Relative RMS error to aim for at every level, 0.000001 to 0.1; or in percent, 0.1%")
          .show_default();
  command
      .add_flag("--verify{64}", bake->verify,
                "Compare N random texels of each level, and the brightest, with brute force, and measure "
                "energy; --verify alone: 64")
      .placeholder("[=N]")
      .within(1, 1000000);
  std::vector<std::string> formats = texel_formats();
  for (const std::string& extension : io::writable_extensions()) formats.push_back(extension);
  command
      .add_option("--format", bake->format,
                  "Stored texels: rgba32f, rgba16f, rgb9e5, r11g11b10, bc6h, uastc-hdr; or of standard "
                  "output, where OUT is -, "
                  "the format: ktx2, exr…, and --type says what is stored")
      .one_of(formats)
      .help_value("TEXT");
  command
      .add_option("--normalisation", bake->normalisation,
                  "average: a constant map is unchanged; integral: times the lobe's integral, of lambert "
                  "the irradiance")
      .one_of({"average", "integral"})
      .show_default();
  command
      .add_option("--filter", bake->filter,
                  "How a level of roughness 0 is resampled: auto (antialiased, keeps the light), nearest, "
                  "bilinear, bicubic, lanczos")
      .show_default();
  command.add_option(
      "--rotate", bake->rotation,
      "Rotate the world: yaw,pitch,roll in degrees, a quaternion w,x,y,z, or nine matrix entries");
  command.add_option("--convention,--to-convention", bake->convention,
                     "World of the output: three.js, blender… (`welkin list conventions`)");
  command
      .add_option(
          "--atlas", bake->atlas,
          "playcanvas: that engine's picture of 512×512 with all levels and the diffuse light, a PNG in "
          "--encoding rgbp")
      .one_of({"playcanvas"});
  command.add_flag("--extract-sun", bake->extract_sun,
                   "Take the strongest light out first, and tell it, to be a light of its own that casts "
                   "shadows; see `lights`");
  command.add_option("--exposure", bake->exposure, "Brighten by this many stops").finite();
  bake->repair.add(command);
  bake->frames.add(command);
  command.add_flag("--json", bake->json, "Machine-readable, on standard output");
  bake->read.add(command);
  bake->read.add_level(command, "Level of the input to take. Default: the finest");
  bake->write.add(command);
  command.callback([bake, command] {
    bake->request = request_of(command);
    if (bake->set.asked(bake->out, command)) {
      bake->request = command_line(command);
      bake->in = input_path(bake->in);
      return bake->run_set();
    }
    const std::vector<std::string> texels = texel_formats();
    const bool stored = std::count(texels.begin(), texels.end(), bake->format) > 0;
    bake->to_stdout = bake->out == "-";
    bake->out = output_path(bake->out, stored ? "" : std::exchange(bake->format, ""));
    bake->in = input_path(bake->in);
    bake->run();
  });
}

}  // namespace welkin::cli
