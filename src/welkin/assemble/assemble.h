#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "welkin/assemble/piece.h"
#include "welkin/base/export.h"
#include "welkin/base/monitor.h"

/// @file
/// A world from pictures of its parts.
namespace welkin {

/// How pieces become a map.
struct AssembleOptions {
  /// R G B where nothing is, and behind what is transparent or fades. Without it black, and edges that have
  /// nothing behind them don't fade.
  std::optional<std::array<float, 3>> fill = {};
  /// Whether the map gets A, how much is covered; then there is no fill.
  bool alpha = false;
  /// Whether pieces of one layer count by how finely they are sampled, in texels per radian, squared, across
  /// where their texels are longest: so the sharper one prevails where they overlap.
  bool by_fineness = true;
  Monitor monitor = {};  ///< progress and cancelling
};

/// What assemble() made.
struct Assembly {
  Map map;  ///< R G B, or R G B A with colours multiplied by alpha; its borders filled
  /// The part of what the map can show that the pieces cover, those of kBackdrop left out, 0 … 1. What is
  /// transparent or fades counts as far as it is opaque.
  double shown = 0;
  std::vector<double> shown_by;  ///< the same of each piece alone
};

/// Assembles a map of this frame. Every texel is the mean of each piece over the texel's area
/// (Filter::automatic), so pieces keep their light where they are reduced. A piece counts by its alpha, its
/// feather, which rises from 0 at its edges as 3t² − 2t³, and its fineness; the pieces of a layer are mixed
/// by what they count. Their layer's opacity is the sum of alpha times feather, at most 1: two whose edges
/// overlap by their feather make a whole, one that ends without neighbour fades. But where nothing is behind,
/// no lower layer and no fill, it is the sum of alpha alone: then feathers mix pieces, and outer edges are
/// sharp.
///
/// The result doesn't depend on the number of threads. Throws Error (bad_request) for no pieces, pieces
/// whose members don't belong together, a fill beside alpha; Cancelled.
WELKIN_API Assembly assemble(std::span<const Piece> pieces, const MapFrame& frame,
                             const AssembleOptions& options = {});

}  // namespace welkin
