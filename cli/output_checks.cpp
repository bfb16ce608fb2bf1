#include <fmt/core.h>

#include "command.h"
#include "welkin/io/output_file.h"
#include "welkin/sphere/convention.h"

namespace welkin::cli {

std::string irradiance_of(const std::string& path) {
  try {
    return io::capabilities_for(path).irradiance;
  } catch (const Error&) {
    return "";  // which is told where the output is checked
  }
}

void fit_to_convention(const std::string& path, const std::string& convention, MapShape& shape) {
  if (convention.empty()) {
    if (path.find("%s") != std::string::npos && shape.layout.kind == LayoutKind::files &&
        shape.parameterization.traits().cube_faces)
      print_warning(
          path,
          "its faces are those of the native world, in which +X is to the left of +Z; engines expect "
          "it to the right: --convention three.js, unity…");
    if (irradiance_of(path) == "babylon")
      print_warning(path,
                    "is in the native world, which no scene of Babylon.js is: --convention babylon or "
                    "babylon-right-handed");
    return;
  }
  const auto fitted = parameterization_for(convention_from_name(convention), shape.parameterization);
  if (fitted == shape.parameterization) return;
  print_warning(
      path, fmt::format("is {}, as {} reads a {}", fitted.name(), convention, shape.parameterization.name()));
  shape.parameterization = fitted;
}

void check_output(const std::string& path, const MapShape& shape, const WriteFlags& flags) {
  const Layout& layout = shape.layout;
  if (!flags.faces.empty()) {
    parse_option("--to-faces", [&] { return with_faces(layout, shape.parameterization, flags.faces); });
  }
  check_extension(path);
  try {
    check_face_pattern(path, layout);
  } catch (const Error& error) {
    throw UsageError(error.what());
  }
  for (const std::filesystem::path& file : files_of(path, shape.parameterization)) {
    try {
      const io::OutputFile unwritten(file);
    } catch (const Error& error) {
      throw in_file(file.string(), error);
    }
  }
}

void check_output_size(ChartSize size, const MapShape& shape, const WriteFlags& flags) {
  parse_option("--size", [&] {
    check_turns(
        flags.faces.empty() ? shape.layout : with_faces(shape.layout, shape.parameterization, flags.faces),
        size);
  });
  if (flags.border > size.width || flags.border > size.height) {
    throw UsageError(fmt::format("--border: {} texels are more than a chart of {}×{} has", flags.border,
                                 size.width, size.height));
  }
}

void check_output_levels(const std::string& path, const MapShape& shape, ChartSize size, int levels,
                         const WriteFlags& flags) {
  try {
    check_chain(path, shape, size, levels, flags.parse());
  } catch (const UsageError&) {
    throw;
  } catch (const Error& error) {
    throw UsageError(error.what());
  }
}

void report_losses(const std::string& path, const io::WriteReport& report) {
  const auto warn = [&](std::uint64_t count, std::string_view what) {
    if (count > 0) print_message(fmt::format("welkin: {}: {} values {}\n", path, count, what));
  };
  warn(report.above, "were above what the file can hold, and clipped");
  warn(report.below, "were negative, and are 0 in the file");
  warn(report.not_finite, "were not finite, and are not in the file");
  if (report.squares > 0)
    print_warning(
        path, fmt::format("its values are rounded to 8 bits with a common factor, with a relative RMS error "
                          "of {:.2g} %",
                          100 * report.relative_rmse()));
}

}  // namespace welkin::cli
