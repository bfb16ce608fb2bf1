#include "sh_output.h"

#include <fmt/core.h>

#include "progress.h"
#include "welkin/harmonics/coefficients_file.h"
#include "welkin/harmonics/project.h"
#include "welkin/io/output_file.h"
#include "welkin/sphere/convention.h"

namespace welkin::cli {

using namespace welkin::harmonics;

void ShOutput::add(Command command) {
  command.add_option(
      "OUT", out,
      "Coefficients to write: .json, .csv, .h, .txt (Filament's); or a map (.exr…). Default: JSON on "
      "standard output");
  std::string names;
  for (const Basis& each : bases()) names += (names.empty() ? "" : ", ") + each.name;
  command.add_option("--basis", basis, names + ". Default: orthonormal, or filament for Filament's text");
  command.add_option("--convention,--to-convention", convention,
                     "World in which they are looked up: unity, unreal… Default: the basis's own");
  command.add_option("--to", to, "Of a map: its parameterization, NAME[:LAYOUT][,PARAMETER=VALUE]")
      .show_default();
  command.add_option("--size", size, "Of a map: its charts' size in texels: N across, or WxH").show_default();
  command.add_option(
      "--format", format,
      "Format of standard output: json, csv, h, filament, or of a map exr, hdr…; default json");
  write.add(command);
}

bool ShOutput::is_text() const {
  return is_coefficients_path(is_stdout() ? "x." + format : out);
}

void ShOutput::check() {
  if (is_stdout() && format.empty()) format = "json";
  if (basis.empty()) {
    const std::string extension = is_stdout() ? format : out.substr(out.rfind('.') + 1);
    basis = is_text() && coefficients_format(extension) == CoefficientsFormat::filament ? "filament"
                                                                                        : "orthonormal";
  }
  const Basis& chosen = parse_option("--basis", [&]() -> const Basis& { return chosen_basis(); });
  if (!convention.empty()) parse_option("--convention", [&] { return convention_from_name(convention); });
  if (!is_stdout() && !format.empty())
    throw UsageError("--format: is for standard output, OUT -; the format of a file follows its extension");
  if (!is_text()) {
    if (!chosen.rows.empty()) throw UsageError("--basis: is for coefficients, not for a map");
    if (is_stdout()) out = output_path(out, format);
    const MapShape shape = parse_option("--to", [&] { return parse_map_shape_for(out, to); });
    return check_output(out, shape, write);
  }
  if (basis != "filament" && coefficients_format(is_stdout() ? format : out.substr(out.rfind('.') + 1)) ==
                                 CoefficientsFormat::filament)
    throw UsageError("--basis: Filament's text is of the basis filament");
  if (is_stdout()) return;
  try {
    const io::OutputFile unwritten(out);
  } catch (const Error& error) {
    throw in_file(out, error);
  }
}

void ShOutput::write_harmonics(const SphericalHarmonics& stored, const std::string& of,
                               const std::string& report) const {
  is_text() ? write_text(stored, of, report) : write_picture(stored);
}

void ShOutput::write_text(const SphericalHarmonics& stored, const std::string& of,
                          const std::string& report) const {
  const Basis& chosen = chosen_basis();
  const std::string world = convention.empty() ? chosen.convention : convention;
  const CoefficientsFormat kind = coefficients_format(is_stdout() ? format : out.substr(out.rfind('.') + 1));
  std::string text = parse_option("--basis", [&] {
    return coefficients_text({to_basis(stored, chosen, convention_from_name(world).lookup), of, world}, kind);
  });
  if (is_stdout()) {
    if (!report.empty() && kind != CoefficientsFormat::json)
      throw UsageError("--json: standard output holds the coefficients, in another format");
    if (!report.empty()) text = text.substr(0, text.rfind("\n}")) + ",\n  \"report\": " + report + "\n}\n";
    return fmt::print("{}", text);
  }
  try {
    io::OutputFile file(out);
    file.write(text.data(), text.size());
    file.commit();
  } catch (const Error& error) {
    throw in_file(out, error);
  }
}

void ShOutput::write_picture(const SphericalHarmonics& stored) const {
  MapShape shape = parse_map_shape_for(out, to);
  fit_to_convention(out, convention, shape);
  const ChartSize chart = parse_chart_size("--size", size, shape.parameterization);
  check_output_size(chart, shape, write);
  shape = for_chart_size(shape, chart);
  const Matrix3 orientation = convention.empty()
                                  ? Matrix3{}
                                  : orientation_for(convention_from_name(convention), shape.parameterization);
  Map map = parse_option("--size", [&] {
    return map_of(stored, shape.parameterization, chart, orientation, progress_monitor("sh"));
  });
  end_progress();
  WriteMapOptions options = write.parse();
  options.convention = convention;
  fit_channels_to(map, out, options);
  report_losses(out, write_map(out, map, shape.layout, options));
}

}  // namespace welkin::cli
