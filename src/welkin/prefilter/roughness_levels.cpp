#include "welkin/prefilter/roughness_levels.h"

#include <algorithm>

#include "welkin/map/chain.h"

namespace welkin {
namespace {

/// The roughness among a lobe's parameters or their synonyms.
std::optional<lobe::Parameter> roughness_parameter(const lobe::AnyLobe& lobe) {
  for (const auto& list : {lobe.parameters(), lobe.synonyms()}) {
    for (const lobe::Parameter& each : list) {
      if (each.name == "roughness") return each;
    }
  }
  return std::nullopt;
}

}  // namespace

std::vector<PrefilterLevel> roughness_levels(const lobe::AnyLobe& lobe, const lobe::RoughnessCurve& curve,
                                             ChartSize finest, int count) {
  const std::optional<lobe::Parameter> parameter = roughness_parameter(lobe);
  std::vector<PrefilterLevel> levels;
  for (int level = 0; level < count; ++level) {
    const double wanted = curve.roughness(level, count);
    const double roughness = parameter ? std::max(wanted, parameter->lowest) : wanted;
    levels.push_back({chain_size(finest, level), lobe.with_roughness(roughness)});
  }
  return levels;
}

std::optional<double> roughness_of(const lobe::AnyLobe& lobe) {
  const std::optional<lobe::Parameter> parameter = roughness_parameter(lobe);
  if (!parameter) return std::nullopt;
  return parameter->value;
}

}  // namespace welkin
