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

/// The narrow sides of a target's footprints, by a sample of them. Infinite where there is none.
struct FootprintSides {
  double narrow;   ///< narrower ones make up a twentieth of the solid angle
  double typical;  ///< half of it
};
FootprintSides footprints_of(const Map& source, const MapFrame& target, const Matrix3& to_source);

/// Whether Filter::automatic reconstructs what is within a source's texels: while footprints are narrower
/// than 1¾ of them. Beyond, it takes texels as they are. For all of a target alike, or light would
/// be lost between two texels that share one of the source's.
bool is_reconstructed(double narrow_side);
bool is_reconstructed(const Map& source, const MapFrame& target, const Matrix3& to_source);

}  // namespace welkin
