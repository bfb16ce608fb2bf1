#pragma once

#include <array>
#include <vector>

#include "welkin/lookup/face_grid.h"

namespace welkin {

/// How bright a grid of masses is at most near a place, on any face and in any of the eight mirror images of
/// one: what weights that are shared by all of these must reckon with. Internal to lookup.
class BrightTiles {
 public:
  /// `inverse`: 1 over what each channel's brightness is counted in.
  BrightTiles(const FaceGrid& masses, const std::array<float, 3>& inverse);

  /// The most among the texels (first_x … last_x, first_y … last_y) of the grid, or somewhat beyond.
  float most(int first_x, int last_x, int first_y, int last_y) const;

 private:
  static constexpr int kTile = 8;
  int side_;   ///< of the grid
  int tiles_;  ///< along half of it, counted from its edge
  std::vector<float> most_;
};

}  // namespace welkin
