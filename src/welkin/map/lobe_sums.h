#pragma once

#include <string>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/map/chain.h"
#include "welkin/map/view_chains.h"

/// @file
/// An ordinary chain with a table that says which of its texels to add for each angle of view and roughness
/// (docs/view-dependent-lobes.md).
namespace welkin {

/// One look-up of a sum.
struct LobeLookUp {
  double weight = 0;  ///< what it counts; those of a sum add up to 1
  double level = 0;   ///< of the chain, a real number
  double lift = 0;    ///< where: this part of the angle from the reflected direction to the normal
  /// Number by number.
  friend bool operator==(const LobeLookUp&, const LobeLookUp&) = default;
};

/// Sums for every pair of an angle of view and a roughness.
struct LobeSums {
  std::string brdf;                  ///< as brdf::AnyBrdf::make takes it, the roughness left out
  std::vector<double> view_cosines;  ///< n·v, ascending, over 0 and at most 1
  std::vector<double> roughness;     ///< ascending; one entry, 0, for a BRDF without roughness
  int count = 1;                     ///< look-ups of a sum; some may have weight 0
  std::vector<LobeLookUp> look_ups;  ///< [view][roughness][count]
  ViewTable albedo;                  ///< [view][roughness]: what to multiply by

  /// The sum of a view and a roughness, both of which there are.
  const LobeLookUp* at(std::size_t view, std::size_t which) const {
    return &look_ups[(view * roughness.size() + which) * static_cast<std::size_t>(count)];
  }
  /// Number by number.
  friend bool operator==(const LobeSums&, const LobeSums&) = default;
};

/// Both. Moved, not copied.
struct LobeSumChain {
  Chain chain;    ///< at least one level
  LobeSums sums;  ///< look-ups of it

  /// Throws Error (mismatch) where the members don't belong together: tables of other sizes, numbers that
  /// aren't finite, levels that the chain lacks, angles or roughness that don't ascend.
  WELKIN_API void check() const;
};

}  // namespace welkin
