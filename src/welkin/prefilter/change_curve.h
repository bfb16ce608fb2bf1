#pragma once

#include <vector>

#include "welkin/base/export.h"
#include "welkin/base/monitor.h"
#include "welkin/lobe/roughness_curve.h"
#include "welkin/map/chain.h"

/// @file
/// A chain for another roughness curve, without the map that it was baked from.
namespace welkin {

/// A level as the mean of two of another chain.
struct LevelMix {
  double roughness = 0;  ///< that the level is for
  int finer = 0;         ///< of the other chain, the last that is not rougher
  int rougher = 0;       ///< and the next; the same one where that is just right, or there is no other
  double share = 0;      ///< of the rougher one, 0 … 1
  /// What the mean of two lobes, and texels larger than the level's, lack to be the lobe: the relative RMS
  /// error that they make of light whose power falls with the square of the degree, as surroundings' does,
  /// and is half in the mean. A guide, not a bound: few small lights make it several times larger.
  double error = 0;
};

/// The levels of a chain for `curve`, each from the two levels of the chain that these are the notes of whose
/// roughness is next to it; their shares are those with the least error. Roughness beyond the chain's is its
/// last level's. `finest` is level 0 of both. Throws Error: (mismatch) notes without a
/// lobe that has a roughness, without the roughness of every level or with one that falls, (bad_request) no
/// levels, more than the size has and as RoughnessCurve does, (unsupported) levels times their lobes'
/// integrals.
WELKIN_API std::vector<LevelMix> mix_levels(const ChainNotes& notes, const MapFrame& finest,
                                            const lobe::RoughnessCurve& curve, int levels);

/// The chain with `levels` levels for `curve`, its notes changed: as mix_levels has it, where a level of the
/// source has another size by resampling. The borders of the source's levels must be filled, and the
/// result's are. Throws as mix_levels does; Cancelled.
WELKIN_API Chain change_roughness_curve(const Chain& chain, const lobe::RoughnessCurve& curve, int levels,
                                        const Monitor& monitor = {});

}  // namespace welkin
