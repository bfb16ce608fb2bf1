#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "welkin/assemble/piece.h"
#include "welkin/base/export.h"
#include "welkin/base/monitor.h"

/// @file
/// How pieces agree where they overlap.
namespace welkin {

/// Two pieces where they overlap.
struct Overlap {
  std::size_t first = 0;   ///< numbers of the pieces
  std::size_t second = 0;  ///< the greater
  double share = 0;        ///< of the sphere, 0 … 1, where both are opaque
  /// Luminance of the second over that of the first, their gains applied: the weighted median.
  double ratio = 1;
  /// Root mean square of the difference of R G B over that of their mean, as they are with their gains.
  double error = 0;
};

/// Compares every two pieces of one layer, by their means over 9216 parts of the sphere of equal area (2.1°
/// across), each weighted by the lower of their finenesses
/// (AssembleOptions::by_fineness) and feathers. Those that overlap in none
/// are left out. Throws as assemble().
WELKIN_API std::vector<Overlap> compare_overlaps(std::span<const Piece> pieces, const Monitor& monitor = {});

/// Multiplies the gains of pieces so that they agree in luminance where they overlap: the logarithms of the
/// medians' ratios are fitted by least squares, weighted by the overlaps' shares. The first piece of those
/// that hang together keeps its gain. Throws as assemble().
WELKIN_API void match_exposures(std::span<Piece> pieces, const Monitor& monitor = {});

}  // namespace welkin
