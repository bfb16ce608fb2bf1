#pragma once

#include <vector>

#include "welkin/prefilter/point_grid.h"

namespace welkin::prefilter {

/// Points that are removed from the grid and summed exactly: the rest has less range, so the truncation error
/// of a finite degree is small relative to dark directions too.
struct BrightPoints {
  std::vector<float> x, y, z;  ///< directions in the source's frame
  std::vector<float> weight;   ///< channels values each, sr · radiance
  int channels = 0;

  int count() const { return static_cast<int>(x.size()); }
};

/// Which points are removed: the largest `always`; and as many as `maximum` when the rest would still ring
/// visibly in the darkest directions. Measured on boxes of light 7° wide, with 64 removed: at 7500
/// times the dimmest radiance, as weight, the worst texel is off by a third of its value.
struct BrightRule {
  double contrast = 16;  ///< only weights above this many times the mean of all
  int always = 64;
  int maximum = 2048;
  double cell =
      1500;  ///< weight in a cell of 8 rows and a 32nd of a row, over the radiance of the dimmest one; sr
  double roughness = 300;  ///< of the rest (see the source), over the same; sr
  double darkest = 1e-5;   ///< the darkest radiance is taken to be at least this part of the mean
};

/// Removes the bright points from the grid.
BrightPoints take_bright_points(PointGrid& grid, const BrightRule& rule, const Monitor& monitor);

}  // namespace welkin::prefilter
