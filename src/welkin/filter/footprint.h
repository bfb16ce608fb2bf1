#pragma once

#include <optional>
#include <vector>

#include "welkin/map/map.h"

namespace welkin {

/// What one texel of a target map covers in a source map: the source texels (of level 0) that a step of one
/// target texel to the right (`right`) and down (`down`) crosses. The 2×2 Jacobian of texel coordinates, by
/// columns.
struct Footprint {
  double right[2];
  double down[2];

  double right_length() const;
  double down_length() const;
  /// The smaller singular value: the width of the footprint across its narrow side.
  double narrow() const;
};

/// `to_source` takes directions of the target's parameterization to the source's. (x, y) in target texels,
/// centres at +½. Found from tangent vectors on the sphere, so neither chart edges nor wraps nor folds
/// disturb it; finite even at poles.
Footprint footprint_at(const Map& source, const MapFrame& target, const Matrix3& to_source, int chart,
                       double x, double y);

/// A rectangle of target texels that is sampled in one manner.
struct FootprintTile {
  int chart, x, y, width, height;
  int samples_right, samples_down;  ///< per texel; 1×1 is one look-up at the centre
  int level;                        ///< of the source's pyramid
  bool whole;  ///< every texel is averaged over all of its area, which spans several source texels
  /// Source texels that a target texel crosses, to the right and down, at the tile's four corners (top left,
  /// top right, bottom left, bottom right).
  float texels_right[4], texels_down[4];
};

/// The fraction of a target texel's side that is averaged when that side crosses `texels` source texels: 0
/// for a look-up at the centre, 1 for the whole side.
float averaged_fraction(float texels);

/// Tiles of a whole target chart row band: covers `rows` rows from `first_row` of `chart`. Tiles are split
/// until the footprint hardly changes within one.
void plan_tiles(const Map& source, const MapFrame& target, const Matrix3& to_source, int chart, int first_row,
                int rows, std::vector<FootprintTile>& tiles);

/// Height of the bands that plan_tiles is meant for.
inline constexpr int kTileSide = 32;

}  // namespace welkin
