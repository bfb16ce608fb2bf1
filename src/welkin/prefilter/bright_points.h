#pragma once

#include <vector>

#include "welkin/prefilter/moments.h"

namespace welkin::prefilter {

/// Masses that are taken out of the grid, to be summed exactly: what is left has less range, so the little
/// that a finite degree leaves out is little beside the dim places too.
struct BrightPoints {
  std::vector<float> x, y, z;  ///< directions in the source's frame
  std::vector<float> mass;     ///< channels values each
  int channels = 0;

  int count() const { return static_cast<int>(x.size()); }
};

/// Which masses are taken out: the largest `always`; and as many as `most` when what rings is still too
/// bright for the dimmest places. Measured on boxes of light 7° wide, with 64 taken: at 7500 times the
/// dimmest radiance, as mass, the worst texel is off by a third of its value.
struct BrightRule {
  double contrast = 16;  ///< only masses above this many times the mean of all
  int always = 64;
  int most = 2048;
  double cell =
      1500;  ///< mass in a cell of 8 rows and a 32nd of a row, over the radiance of the dimmest one; sr
  double roughness = 300;  ///< of the rest, see the source, over the same; sr
  double darkest = 1e-5;   ///< places count as no darker than this part of the mean radiance
};

/// Takes the bright masses out of the grid.
BrightPoints take_bright_points(Moments& moments, const BrightRule& rule, const Monitor& monitor);

}  // namespace welkin::prefilter
