#pragma once

#include <optional>
#include <string>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/map/map.h"

/// @file
/// Chains: the levels of a texture, each half as large as the one before (docs/chains.md).
namespace welkin {

/// What the levels of a chain hold, in words: stored with it, and shown to whoever reads it. A file may say
/// anything here; nothing is computed from it.
struct WELKIN_API ChainNotes {
  std::string lobe;  ///< that the levels are filtered with, as lobe::AnyLobe::make takes it, the roughness
                     ///< left out: `ggx`. Empty for plain maps
  std::vector<double> roughness;  ///< of each level; empty where the lobe has none
  std::string curve;              ///< how roughness goes with the level: `linear`, `filament`…
  std::string
      normalisation;     ///< `radiance`: a constant map stays what it is; `integral`: LobeScale::integral
  std::string software;  ///< that made the chain

  /// Whether nothing is noted.
  bool empty() const;
  /// Roughness of a level; none where the file doesn't tell.
  std::optional<double> roughness_of(int level) const;
  /// The notes on one of the levels, alone in its file.
  ChainNotes of_level(int level) const;

  /// Note by note.
  friend bool operator==(const ChainNotes&, const ChainNotes&) = default;
};

/// Maps that belong together as levels. Moved, not copied.
struct Chain {
  /// Level 0, the finest, first. Level k's charts have chain_size(level 0's, k); the parameterization
  /// (at_size), orientation and channels are the same in all. At least one.
  std::vector<Map> levels;
  /// What they hold.
  ChainNotes notes;
};

/// Charts of level `level`, 0 … 30: max(1, side >> level) in each axis.
WELKIN_API ChartSize chain_size(ChartSize finest, int level);

/// How many levels charts of this size have, down to 1×1.
WELKIN_API int max_levels(ChartSize finest);

}  // namespace welkin
