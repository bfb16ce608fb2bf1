#include <fmt/core.h>

#include <algorithm>
#include <memory>

#include "command.h"
#include "sanitize_flags.h"
#include "sh_output.h"
#include "sh_report.h"
#include "welkin/harmonics/coefficients_file.h"
#include "welkin/harmonics/project.h"

namespace welkin::cli {
namespace {

using namespace welkin::harmonics;

/// Degrees that an error is measured against, at least and at most.
constexpr int kLeastReference = 48, kMostReference = kMaxDegree;

struct Sh {
  std::string in, of, window = "none", deringing = "none", rotate;
  std::optional<int> order;
  bool json = false, quiet = false;
  ReadFlags read;
  SanitizeFlags sanitize;
  ShOutput output;

  void run();

 private:
  void check();
  Map read_map() const;
  /// The input's harmonics; `map` becomes the map, where it is one.
  CoefficientsFile load(std::optional<Map>& map) const;
  /// Factors of irradiance, or of the lobe.
  std::vector<double> factors(int degree) const;
};

bool is_lobe(const std::string& of) {
  return !of.empty() && of != "radiance" && of != "irradiance";
}

void Sh::check() {
  read.parse();
  output.check();
  parse_option("--window", [&] { return window_from_name(window); });
  if (is_lobe(of)) parse_option("--of", [&] { return lobe::AnyLobe::make(of); });
  const Basis& basis = output.chosen_basis();
  if (basis.rows.empty()) return;
  if (!of.empty() && of != "radiance")
    throw UsageError(fmt::format("--of: basis {} has its own factors: it is of radiance", basis.name));
  if (order.value_or(2) > basis.degree)
    throw UsageError(fmt::format("--order: basis {} has order {}", basis.name, basis.degree));
}

Map Sh::read_map() const {
  Map map = read.read(in).map;
  if (sanitize.any()) {
    const SanitizeOptions options = sanitize.parse(65504);
    sanitize.print(in, welkin::sanitize(map, options), options);
  }
  if (!map.parameterization.whole_world())
    print_warning(in, fmt::format("shows {:.3g} % of the sphere; the rest counts as 0",
                                  100 * map.parameterization.coverage() / (4 * kPi)));
  return map;
}

CoefficientsFile Sh::load(std::optional<Map>& map) const {
  if (is_coefficients_path(in)) {
    CoefficientsFile file = read_coefficients(in);
    if (order.value_or(0) > file.coefficients.degree)
      throw UsageError(fmt::format("--order: {} has order {}", in, file.coefficients.degree));
    return file;
  }
  map = read_map();
  const int degree = order.value_or(2);
  const ChartSize size{map->width(), map->height()};
  if (const int largest = degree > 2 ? largest_degree(map->parameterization, size) : degree; degree > largest)
    print_warning(
        in, fmt::format("order {} is finer than its texels, which hold orders up to {}", degree, largest));
  try {
    const SphericalHarmonics found = project(*map, degree, progress_monitor("sh"));
    end_progress();
    return {to_basis(found, bases().front(), {}), "radiance", "native"};
  } catch (const Error& error) {
    const bool repairable = error.kind() == ErrorKind::bad_value && !sanitize.any();
    throw Error(error.kind(), in, error.cause() + (repairable ? "; --sanitize repairs them" : ""));
  }
}

std::vector<double> Sh::factors(int degree) const {
  return is_lobe(of) ? lobe_factors(lobe::AnyLobe::make(of), degree) : irradiance_factors(degree);
}

void Sh::run() {
  check();
  std::optional<Map> map;
  const CoefficientsFile loaded = load(map);
  const bool convolve = loaded.of == "radiance";
  if (!convolve && !of.empty() && of != loaded.of)
    throw UsageError(fmt::format("--of: {} holds {} already", in, printable(loaded.of)));
  if (!convolve && !output.chosen_basis().rows.empty())
    throw UsageError(
        fmt::format("--basis: {} is of radiance; {} holds {}", output.basis, in, printable(loaded.of)));
  if (of.empty()) of = loaded.of;

  const SphericalHarmonics whole = harmonics_of(loaded);
  SphericalHarmonics found = with_degree(whole, order.value_or(whole.degree()));
  const int degree = found.degree();
  const std::vector<double> zonal =
      convolve ? factors(degree) : std::vector<double>(static_cast<std::size_t>(degree) + 1, 1.0);
  found = convolved(found, window_factors(window_from_name(window), degree));
  ShReport report{of == "radiance" ? "irradiance" : of, found, {}, 0, {}};
  if (deringing != "none") {
    report.deringing =
        dering(found, zonal, deringing == "minimal" ? DeringChannels::each : DeringChannels::together);
    found = report.deringing->harmonics;
  }
  if (map) {
    const int high = std::max(degree, std::clamp(2 * degree + 16, kLeastReference, kMostReference));
    const SphericalHarmonics reference = reference_of(*map, whole, high, progress_monitor("sh"));
    report.error = error_of(found, reference, factors(high));
    report.beyond = most_beyond(*map, reference, factors(high));
    end_progress();
  }
  if (!json && !quiet) print(in, report);
  if (!rotate.empty()) found = rotated(found, parse_rotation("--rotate", rotate));
  report.radiance = found;
  const std::string text = json ? json_of(report).dump(output.is_stdout() ? -1 : 2) : "";
  output.write_harmonics(convolve && of != "radiance" ? convolved(found, zonal) : found, of, text);
  if (json && !output.is_stdout()) fmt::print("{}\n", text);
}

}  // namespace

void add_sh(Command app) {
  auto sh = std::make_shared<Sh>();
  Command command = app.add_command("sh", "Spherical harmonics of a map's light, or a map of coefficients");
  command
      .add_option("IN", sh->in,
                  "Map to read, - is standard input; or coefficients: .json, .csv, .txt (Filament's)")
      .required();
  command.add_option("--order", sh->order, "The largest degree. Default: 2, or what the coefficients have")
      .within(0, kMaxDegree);
  command.add_option(
      "--of", sh->of,
      "radiance, irradiance, or what a lobe makes of it: NAME[,PARAMETER=VALUE]. Default: radiance");
  command.add_option("--window", sh->window, "Let high degrees fade: none, hann, lanczos").show_default();
  command
      .add_option("--deringing", sh->deringing,
                  "minimal: irradiance, or what --of says, nowhere negative with the least change, each "
                  "channel for itself; together: with one factor for all channels")
      .one_of({"none", "minimal", "together"})
      .show_default();
  command.add_option("--rotate", sh->rotate,
                     "Rotate the world: yaw,pitch,roll in degrees, quaternion w,x,y,z or 9 matrix entries");
  command.add_flag("--json", sh->json,
                   "The error, the linear part and the zonal fit as JSON: with the coefficients on standard "
                   "output, else alone; not on stderr");
  sh->output.add(command);
  sh->read.add(command);
  sh->read.add_level(command, "Level of the file to read. Default: 0");
  sh->sanitize.add(command);
  command.callback([sh, app] {
    sh->quiet = app.option("--quiet").given();
    sh->in = input_path(sh->in);
    sh->run();
  });
}

}  // namespace welkin::cli
