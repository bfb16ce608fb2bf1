#include "sanitize_flags.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "progress.h"
#include "welkin/base/number_text.h"
#include "welkin/io/capabilities.h"

namespace welkin::cli {
namespace {

constexpr double kLargestHalf = 65504;

/// A number that a float holds, of `--sanitize` or `--clamp`.
float parse_value(std::string_view option, const std::string& text) {
  const std::optional<double> value = parse_number(text);
  if (!value || !std::isfinite(static_cast<float>(*value)))
    throw UsageError(fmt::format("{}: '{}' is not a number", option, printable(text)));
  return static_cast<float>(*value);
}

double largest_of(io::PixelType type, const io::Capabilities& format) {
  switch (type) {
    case io::PixelType::uint8:
    case io::PixelType::uint16:
      return 1;
    case io::PixelType::uint32:
      // EXR's are whole numbers as they are.
      return format.format == "exr" ? kLargestHalf : 1;
    case io::PixelType::half:
    case io::PixelType::bc6h:
    case io::PixelType::uastc_hdr:
    case io::PixelType::astc_hdr:
    case io::PixelType::float32:
      return kLargestHalf;
    case io::PixelType::rgb9e5:
      return 65408;
    case io::PixelType::r11g11b10:
      return 64512;
  }
  return kLargestHalf;
}

}  // namespace

void SanitizeFlags::add(Command command) {
  command
      .add_flag("--sanitize{fill}", sanitize,
                "Repair NaN and infinite values. fill (--sanitize alone): both become what is around them; "
                "clamp: infinite ones become the largest value of the output's type (65504 of half, and of "
                "float), clamp:VALUE: VALUE, NaN what is around it")
      .placeholder("[=fill|clamp[:VALUE]]");
  command.add_option("--clamp", clamp,
                     "Clamp the input's values to MIN,MAX; either may be left out: ,65504 or 0,");
}

SanitizeOptions SanitizeFlags::parse(double largest) const {
  SanitizeOptions options;
  options.fill = !sanitize.empty();
  if (sanitize.starts_with("clamp")) {
    options.infinite = static_cast<float>(largest);
    if (sanitize.starts_with("clamp:")) options.infinite = parse_value("--sanitize", sanitize.substr(6));
    if (!(*options.infinite > 0)) throw UsageError("--sanitize: infinite values become a value above 0");
  }
  if (!sanitize.empty() && sanitize != "fill" && sanitize != "clamp" && !sanitize.starts_with("clamp:")) {
    throw UsageError(fmt::format("--sanitize: '{}' is not fill, clamp or clamp:VALUE", printable(sanitize)));
  }
  if (clamp.empty()) return options;
  const std::size_t comma = clamp.find(',');
  if (comma == std::string::npos || clamp.find(',', comma + 1) != std::string::npos || clamp == ",")
    throw UsageError(fmt::format(
        "--clamp: '{}' is not MIN,MAX, of which one may be left out: 0,65504 or ,65504", printable(clamp)));
  if (comma > 0) options.minimum = parse_value("--clamp", clamp.substr(0, comma));
  if (comma + 1 < clamp.size()) options.maximum = parse_value("--clamp", clamp.substr(comma + 1));
  if (options.minimum > options.maximum)
    throw UsageError(
        fmt::format("--clamp: the minimum {} is above the maximum {}", options.minimum, options.maximum));
  return options;
}

void SanitizeFlags::print(const std::string& in, const SanitizeReport& report,
                          const SanitizeOptions& options) const {
  std::string text;
  const auto tell = [&](const std::string& what) { text += (text.empty() ? "" : ", ") + what; };
  if (options.fill) {
    tell(fmt::format("{} texels with NaN{} values filled", report.filled,
                     options.infinite ? "" : " or infinite"));
  }
  if (options.infinite)
    tell(fmt::format("{} infinite values clamped to {:g}", report.infinite, *options.infinite));
  if (!clamp.empty()) tell(fmt::format("{} values clamped to {}", report.clamped, printable(clamp)));
  print_message(fmt::format("welkin: {}: {}\n", in, text));
}

bool holds_negative(const std::string& out, std::optional<io::PixelType> type) {
  const io::Capabilities& format = io::capabilities_for(out);
  const io::PixelType stored = type.value_or(format.types.front());
  return format.negative && (stored == io::PixelType::half || stored == io::PixelType::float32);
}

double largest_value(const std::string& out, std::optional<io::PixelType> type, double factor) {
  const io::Capabilities& format = io::capabilities_for(out);
  const double largest = largest_of(type.value_or(format.types.front()), format) / std::fabs(factor);
  return std::isfinite(largest) && largest > 0 ? std::min(largest, 1e30) : kLargestHalf;
}

}  // namespace welkin::cli
