#include "welkin/lookup/roughness_level.h"

#include <algorithm>
#include <cstddef>

#include "welkin/base/error.h"

namespace welkin {
namespace {

void check(const ChainNotes& notes) {
  require(!notes.roughness.empty(), "a chain's notes tell no roughness of its levels");
  require(std::is_sorted(notes.roughness.begin(), notes.roughness.end()),
          "a chain's roughness falls from one level to the next");
}

void check(double roughness) {
  require(roughness >= 0 && roughness <= 1, "a roughness is not a number of 0 to 1");
}

double level_of(const std::vector<double>& levels, double roughness) {
  const auto above = std::lower_bound(levels.begin(), levels.end(), roughness);
  if (above == levels.begin()) return 0;
  if (above == levels.end()) return static_cast<double>(levels.size() - 1);
  const double smooth = *(above - 1), rough = *above;
  return static_cast<double>(above - levels.begin() - 1) + (roughness - smooth) / (rough - smooth);
}

}  // namespace

double level_of_roughness(const ChainNotes& notes, double roughness) {
  check(notes);
  check(roughness);
  return level_of(notes.roughness, roughness);
}

void levels_of_roughness(const ChainNotes& notes, std::span<const float> roughness, std::span<float> levels) {
  check(notes);
  require(levels.size() >= roughness.size(), "there is less room for levels than there are roughnesses");
  for (const float each : roughness) check(static_cast<double>(each));
  for (std::size_t i = 0; i < roughness.size(); ++i) {
    levels[i] = static_cast<float>(level_of(notes.roughness, static_cast<double>(roughness[i])));
  }
}

}  // namespace welkin
