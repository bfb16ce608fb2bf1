#pragma once

#include <vector>

#include "welkin/sphere/registry.h"

/// The area of a part of a chart as quadrature points, also where the rim of a disc or the side of a triangle
/// cuts it.
namespace welkin {

/// Gauss's two points in 0 … 1: ½ ∓ 1/√12.
inline constexpr double kGauss[2] = {0.21132486540518713, 0.78867513459481287};

/// A rectangle of a chart, in its u and v.
struct ChartCell {
  int chart;
  double u, v;  ///< the smallest
  double width, height;

  /// Part `x` of `columns`, `y` of `rows`.
  ChartCell part(int x, int columns, int y, int rows) const;
};

struct TexelPoint {
  Vec3d direction;
  double solid_angle;
};

/// Gauss's rule of 2×2 points, of a cell that lies within the chart's valid positions.
void append_gauss_points(const sphere::AnyParameterization& p, const ChartCell& cell,
                         std::vector<TexelPoint>& points);

/// Limits of subdivision.
struct CellLimits {
  double solid_angle;  ///< sr: until subdividing changes it by less
  double side = 10;    ///< radians: until points are no farther apart
  int rim_depth = 1;   ///< subdivisions at a rim, before it is followed in strips
};

/// Points of the valid part of any cell, subdivided to these limits; none when no part is valid. At a rim the
/// solid angle is exact to about 1e-6 of a texel's, and to 3e-3 of it where the density is infinite there.
void append_points(const sphere::AnyParameterization& p, const ChartCell& cell, const CellLimits& limits,
                   std::vector<TexelPoint>& points);

}  // namespace welkin
