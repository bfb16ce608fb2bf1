#include "welkin/prefilter/roughness_levels.h"

#include <algorithm>

#include "welkin/map/chain.h"

namespace welkin {
namespace {

/// The roughness among a lobe's parameters or their synonyms.
std::optional<Parameter> roughness_parameter(const lobe::AnyLobe& lobe) {
  for (const auto& list : {lobe.parameters(), lobe.synonyms()}) {
    for (const Parameter& each : list) {
      if (each.name == "roughness") return each;
    }
  }
  return std::nullopt;
}

}  // namespace

std::vector<PrefilterLevel> roughness_levels(const lobe::AnyLobe& lobe, const lobe::RoughnessCurve& curve,
                                             ChartSize finest, int count) {
  const std::optional<Parameter> parameter = roughness_parameter(lobe);
  const double minimum = parameter ? parameter->minimum : 0;
  std::vector<PrefilterLevel> levels;
  for (int level = 0; level < count; ++level) {
    double roughness = curve.roughness(level, count);
    if (roughness < minimum && curve.listed_levels() == 0) {
      const double next = level + 1 < count ? curve.roughness(level + 1, count) : 1;
      roughness = std::max(next / 2, minimum);
    }
    levels.push_back({chain_size(finest, level), lobe.with_roughness(roughness)});
  }
  return levels;
}

std::optional<double> roughness_of(const lobe::AnyLobe& lobe) {
  const std::optional<Parameter> parameter = roughness_parameter(lobe);
  if (!parameter) return std::nullopt;
  return parameter->value;
}

}  // namespace welkin
