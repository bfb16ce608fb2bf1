#include <fmt/core.h>

#include <memory>

#include "command.h"
#include "progress.h"
#include "sanitize_flags.h"
#include "welkin/light/importance_file.h"
#include "welkin/map/adjust.h"

namespace welkin::cli {
namespace {

struct Importance {
  std::string in, out, method = "cdf", look_up = "nearest";
  bool compensate = false, json = false;
  ReadFlags read;
  SanitizeFlags repair;

  void run() const;
  ImportanceOptions parse() const;
  void check_out() const;
  void print(const ImportanceSampler& sampler, const std::vector<std::filesystem::path>& files) const;
};

ImportanceOptions Importance::parse() const {
  ImportanceOptions options;
  options.method = parse_option("--method", [&] { return importance_method_from_name(method); });
  options.look_up = look_up == "bilinear" ? Filter::bilinear : Filter::nearest;
  options.compensate = compensate;
  return options;
}

/// Before any work: a format and a folder that take the tables.
void Importance::check_out() const {
  check_extension(out);
  const std::string format = io::capabilities_for(out).format;
  if (format != "exr" && format != "ktx2")
    throw UsageError(out + ": tables are written as .exr or .ktx2, which hold 32-bit floats as they are");
  io::WriteOptions options;
  options.type = io::PixelType::float32;
  io::check_write(out, 1, 1, {"R", "G", "B", "A"}, options);
}

void Importance::print(const ImportanceSampler& sampler,
                       const std::vector<std::filesystem::path>& files) const {
  if (json) {
    std::vector<std::string> tables;
    for (std::size_t i = 0; i + 1 < files.size(); ++i) tables.push_back(files[i].filename().string());
    fmt::print("{}", importance_header(sampler, tables));
    return;
  }
  const MapFrame& frame = sampler.frame();
  fmt::print("{}: {} {}×{}, tables of {}{}\n", in, frame.parameterization.spec(), frame.size.width,
             frame.size.height, method, compensate ? ", compensated" : "");
  fmt::print("mean luminance {:.6g}, integral {:.6g}\n", sampler.mean_luminance(), sampler.integral());
  for (const auto& file : files) fmt::print("{}\n", file.string());
}

void Importance::run() const {
  read.parse();
  const ImportanceOptions options = parse();
  const SanitizeOptions repairs = repair.parse(65504);
  check_out();
  Map map = read.read(in).map;
  if (repair.any()) repair.print(in, sanitize(map, repairs), repairs);
  try {
    const ImportanceSampler sampler(map, options, progress_monitor("importance"));
    end_progress();
    if (sampler.is_uniform()) {
      print_warning(in, compensate ? "nothing is brighter than the mean: the tables are uniform"
                                   : "there is no light: the tables are uniform");
    }
    if (sampler.negative_texels() > 0)
      print_warning(
          in, fmt::format("{} texels have negative luminance, which counts as 0", sampler.negative_texels()));
    if (!map.parameterization.whole_world()) {
      print_warning(in, fmt::format("shows {:.1f} % of the sphere; nothing else is ever drawn",
                                    100 * map.parameterization.coverage() / (4 * kPi)));
    }
    print(sampler, write_importance(out, sampler, progress_monitor("write")));
    end_progress();
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::bad_value || !error.file().empty()) throw;
    throw Error(ErrorKind::bad_value, in, error.cause() + ": --sanitize does");
  }
}

}  // namespace

void add_importance(Command app) {
  auto importance = std::make_shared<Importance>();
  Command command = app.add_command(
      "importance", "Write tables for importance sampling: for renderers that draw directions towards light");
  command.add_option("IN", importance->in, "Map to read; - is standard input").required();
  command
      .add_option("OUT", importance->out,
                  "Tables, .exr or .ktx2. Of cdf also OUT_rows with the rows' distribution; always a header, "
                  ".json")
      .required();
  command
      .add_option("--method", importance->method,
                  "cdf: row, then column, by inversion, which keeps strata; alias: one look-up a draw")
      .show_default();
  command.add_flag("--compensate", importance->compensate,
                   "For multiple importance sampling: subtract the mean, and never draw what is darker");
  command
      .add_option("--look-up", importance->look_up,
                  "How the renderer reads the map: nearest, or bilinear, whose light reaches a texel farther")
      .one_of({"nearest", "bilinear"})
      .show_default();
  command.add_flag("--json", importance->json, "Print the header instead of a summary");
  importance->read.add(command);
  importance->repair.add(command);
  command.callback([importance] {
    importance->in = input_path(importance->in);
    importance->run();
  });
}

}  // namespace welkin::cli
