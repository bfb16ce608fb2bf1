#pragma once

#include <vector>

#include "welkin/map/map.h"

/// The area of a texel as quadrature points. Gauss's rule of 2×2 points suffices for most texels; not for
/// those that the rim of a disc or the side of a triangle cuts, nor where the density has a kink, as along
/// the diagonals of an octahedron, nor for those that cover a large part of the sphere.
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

/// A texel of charts of that size.
ChartCell texel_cell(ChartSize size, int chart, int x, int y);

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
  int rim_depth = 3;   ///< subdivisions at a rim, before it is followed in strips
};

/// Points of the valid part of any cell, subdivided to these limits; none when no part is valid. At a rim the
/// solid angle is too small by about 1e-4 of a texel's, by 6e-4 of that of a quarter of a disc.
void append_points(const sphere::AnyParameterization& p, const ChartCell& cell, const CellLimits& limits,
                   std::vector<TexelPoint>& points);

/// A side of a texel of average solid angle, radians.
double mean_texel(const sphere::AnyParameterization& p, ChartSize size);

/// A millionth of a texel of average solid angle.
CellLimits texel_limits(const sphere::AnyParameterization& p, ChartSize size);

/// How a texel is to be integrated.
enum class TexelKind : unsigned char {
  outside,    ///< not valid anywhere
  plain,      ///< 2×2 points give its solid angle within 1e-5
  irregular,  ///< append_points
};

/// Whether a texel is not valid at any of 25 points: those that kinds and solid angles go by, its corners a
/// thousandth of it inward, so that one which only touches a rim is outside.
bool is_outside_texel(const sphere::AnyParameterization& p, ChartSize size, int chart, int x, int y);

/// Sets to 1 those of `mask` that are 0 but not outside: the masks of `count` texels of a row from x on, 1
/// where their centres are valid.
void add_rim_texels(const sphere::AnyParameterization& p, ChartSize size, int chart, int x, int y, int count,
                    float* mask);

/// The kinds of the texels of a chart's row.
std::vector<TexelKind> texel_kinds(const sphere::AnyParameterization& p, ChartSize size, int chart, int row);

/// Solid angles of the texels of a chart's row, sr, as the points above have them.
std::vector<double> summed_solid_angles(const sphere::AnyParameterization& p, ChartSize size, int chart,
                                        int row);

/// texel_solid_angles, but 0 for texels whose centre is not valid: for what looks maps up at centres, where
/// those show other directions than their own.
void centred_solid_angles(const sphere::AnyParameterization& p, ChartSize size, int chart, int row,
                          float* out);

}  // namespace welkin
