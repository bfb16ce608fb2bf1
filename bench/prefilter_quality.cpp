// How far pre-filtered levels are from brute force in float64, on maps that resemble real environments and on
// hostile ones.

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "harness.h"
#include "lighting.h"
#include "pictures.h"
#include "welkin/prefilter/verify.h"

namespace {

using namespace welkin;
using namespace welkin::bench;

/// Largest errors that levels may have; 0 where that isn't judged.
struct Targets {
  double rmse = 0, maximum = 0;
};

/// 2e-05.
std::string scientific(double value) {
  char text[64];
  std::snprintf(text, sizeof text, "%.0e", value);
  return text;
}

void map_row(const std::string& name, const Map& map, const Targets& targets, const Table& table) {
  const auto chain = ggx_chain(256, 9);
  const auto levels = prefilter_map(map, sphere::AnyParameterization::make("cube"), chain);
  std::vector<std::string> cells{name};
  LevelErrors worst;
  {
    const PrefilterReference reference(map);
    for (std::size_t k = 1; k < levels.size(); ++k) {
      const LevelErrors errors = errors_of(reference, levels[k], chain[k].lobe);
      cells.push_back(errors_cell(errors));
      worst.relative_rmse = std::max(worst.relative_rmse, errors.relative_rmse);
      worst.maximum = std::max(worst.maximum, errors.maximum);
    }
  }
  double energy = 0, mirror = 0, furnace = 0;
  VerifyOptions sums;
  sums.random_texels = sums.most_hot = 1;
  const auto results = verify_prefilter(map, levels, chain, sums);
  for (std::size_t k = 0; k < results.size(); ++k) {
    double& farthest = k == 0 ? mirror : energy;
    farthest = std::max(farthest, std::fabs(results[k].energy.value() - 1));
    furnace = std::max(furnace, results[k].furnace.value());
  }
  for (const double each : {energy, mirror, furnace}) cells.push_back(scientific(each));
  const bool judged = targets.maximum > 0;
  cells.push_back(!judged            ? ""
                  : targets.rmse > 0 ? "≤ " + percent(targets.rmse) + " / " + percent(targets.maximum)
                                     : "max ≤ " + percent(targets.maximum));
  cells.push_back(!judged ? ""
                          : met(worst.maximum <= targets.maximum &&
                                (targets.rmse == 0 || worst.relative_rmse <= targets.rmse)));
  table.row(cells);
}

Table start_table() {
  return Table(
      {"map", "⅛", "¼", "⅜", "½", "⅝", "¾", "⅞", "1", "energy", "of level 0", "furnace", "target", "met"});
}

}  // namespace

int main() {
  const Threads threads;
  heading("Pre-filtering: errors");
  paragraph(
      "1024×512 to the same chain of 9 levels, with the default tolerance: relative RMSE % / maximum % at "
      "each "
      "roughness, against brute force over all texels in float64. The RMSE is over 300 random texels (all "
      "of "
      "small levels), the maximum also over the 100 brightest; both over the three channels together. "
      "*Energy*: how far a filtered level's integral is from the source's, relatively; *of level 0*: the "
      "same "
      "of the resampled one, summed over its texels; *furnace*: how far a map that is 1 everywhere is from "
      "1. "
      "Each is the worst level's.");
  {
    const HighDynamicRange real = high_dynamic_range();
    const Table table = start_table();
    map_row(real.name, real.map, real.is_forest ? Targets{2e-4, 5e-3} : Targets{}, table);
    for (const NamedMap& each : built_in_lighting()) map_row(each.name, each.map, {}, table);
  }
  heading("Pre-filtering: errors on hostile maps");
  paragraph("The same, on suns that are a million times as bright as the rest, on a lamp, and on many.");
  const Table table = start_table();
  for (const NamedMap& each : hostile_lighting()) map_row(each.name, each.map, {0, 1e-2}, table);
}
