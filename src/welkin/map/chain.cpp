#include "welkin/map/chain.h"

#include "welkin/base/error.h"

#include <algorithm>

namespace welkin {

bool ChainNotes::empty() const {
  return *this == ChainNotes{};
}

std::optional<double> ChainNotes::roughness_of(int level) const {
  const auto index = static_cast<std::size_t>(level);
  if (index >= roughness.size()) return std::nullopt;
  return roughness[index];
}

ChainNotes ChainNotes::of_level(int level) const {
  ChainNotes notes = *this;
  notes.roughness.clear();
  if (const std::optional<double> own = roughness_of(level)) notes.roughness = {*own};
  return notes;
}

ChartSize chain_size(ChartSize finest, int level) {
  require(level >= 0 && level < 31, "levels of a chain are 0 to 30");
  return {std::max(1, finest.width >> level), std::max(1, finest.height >> level)};
}

int max_levels(ChartSize finest) {
  int levels = 1;
  while ((std::max(finest.width, finest.height) >> levels) > 0) ++levels;
  return levels;
}

}  // namespace welkin
