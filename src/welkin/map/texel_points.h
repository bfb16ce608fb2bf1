#pragma once

#include <vector>

#include "welkin/map/cell_points.h"
#include "welkin/map/map.h"

/// The area of a texel as quadrature points. Gauss's rule of 2×2 points suffices for most texels; not for
/// those that the rim of a disc or the side of a triangle cuts, nor where the density has a kink, as along
/// the diagonals of an octahedron, nor for those that cover a large part of the sphere.
namespace welkin {

/// A texel of charts of that size.
ChartCell texel_cell(ChartSize size, int chart, int x, int y);

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
