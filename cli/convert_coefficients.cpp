#include "convert_coefficients.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "sh_output.h"
#include "welkin/harmonics/coefficients_file.h"

namespace welkin::cli {
namespace {

using namespace welkin::harmonics;

/// Options of `convert` that mean something for coefficients; any other is about texels of the input.
constexpr std::array<std::string_view, 14> kMeantForCoefficients{
    "to",       "size", "rotate",   "convention", "exposure", "scale",  "format",
    "to-faces", "type", "encoding", "to-colour",  "quality",  "border", "compression"};

ShOutput output_for(const CoefficientsToMap& request) {
  ShOutput output;
  output.out = request.out;
  output.convention = request.convention;
  output.write = request.write;
  if (!request.to.empty()) output.to = request.to;
  if (!request.size.empty()) output.size = request.size;
  if (output.is_text())
    throw UsageError(
        fmt::format("{}: coefficients become other coefficients by `welkin sh`", printable(request.out)));
  return output;
}

}  // namespace

void CoefficientsToMap::run() const {
  ShOutput output = output_for(*this);
  output.check();
  const CoefficientsFile file = read_coefficients(in);
  SphericalHarmonics harmonics = harmonics_of(file);
  if (!rotation.empty()) harmonics = rotated(harmonics, parse_rotation("--rotate", rotation));
  for (double& value : harmonics.values()) value *= factor;
  output.write_harmonics(harmonics, file.of, "");
}

void check_coefficients_options(const Command& convert) {
  for (const Option& option : convert.options()) {
    if (!option.given() || option.positional()) continue;
    const std::string name = option.long_names().front();
    if (std::find(kMeantForCoefficients.begin(), kMeantForCoefficients.end(), name) ==
        kMeantForCoefficients.end())
      throw UsageError(fmt::format("--{}: is about texels, of which coefficients have none", name));
  }
}

}  // namespace welkin::cli
