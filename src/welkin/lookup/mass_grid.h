#pragma once

#include <vector>

#include "welkin/base/monitor.h"
#include "welkin/lookup/face_grid.h"
#include "welkin/map/map.h"

namespace welkin {

/// What a map's texels send to the points of equi-angular cubes. Internal to lookup.
///
/// A texel is its radiance over its solid angle, as Gauss's 2×2 points; each point is spread onto 3×3 grid
/// texels by the quadratic B-spline B, so a grid texel holds ∫ B(g − g_j) L dω, g measured in texels: nothing
/// is lost, and nothing becomes negative. A sum of these with a kernel's values is L blurred by that kernel
/// convolved with B. The fourth value is the same of a map that is 1 where the map shows something; or, when
/// it does not show all of the sphere, the solid angle of the grid texel.
class MassGrid {
 public:
  /// Of up to three channels from `first` on, in the world's frame. Size and margin are multiples of
  /// 2^(levels − 1); each level has texels of twice the side. The two outermost rings of a margin are
  /// incomplete.
  MassGrid(const Map& map, int first, int size, int margin, int levels, const Monitor& monitor);

  const FaceGrid& level(int index) const { return levels_[static_cast<std::size_t>(index)]; }

 private:
  std::vector<FaceGrid> levels_;
};

}  // namespace welkin
