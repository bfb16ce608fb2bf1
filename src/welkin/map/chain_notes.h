#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace welkin {

/// What the levels of a chain hold, in words: stored with it, and shown to whoever reads it. A file may say
/// anything here; nothing is computed from it.
struct ChainNotes {
  std::string lobe;  ///< that the levels are filtered with, as lobe::AnyLobe::make takes it, the roughness
                     ///< left out: `ggx`. Empty for plain maps
  std::vector<double> roughness;  ///< of each level; empty where the lobe has none
  std::string curve;              ///< how roughness goes with the level: `linear`, `filament`…
  std::string normalisation;      ///< `radiance`: a constant map stays what it is
  std::string software;           ///< that made the chain

  bool empty() const;
  /// None where the file doesn't tell.
  std::optional<double> roughness_of(int level) const;
  /// The notes on one of the levels, alone in its file.
  ChainNotes of_level(int level) const;

  friend bool operator==(const ChainNotes&, const ChainNotes&) = default;
};

/// As text metadata: `welkin.lobe`, `welkin.roughness` (`0,0.125,…`), `welkin.roughness-curve`,
/// `welkin.normalisation`, `welkin.software`, those that aren't empty.
std::map<std::string, std::string> attributes_of(const ChainNotes& notes);

/// The reverse. Numbers that are none, not finite or negative make no roughness at all, and neither do more
/// of them than a chain can have levels; it never throws.
ChainNotes chain_notes_from(const std::map<std::string, std::string>& attributes);

}  // namespace welkin
