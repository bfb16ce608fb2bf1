#pragma once

#include <vector>

#include "welkin/map/texel_points.h"

/// Quadrature points of texels for functions of a degree. Internal to harmonics.
namespace welkin::harmonics {

/// The points of the texels of a row, texel after texel.
struct RowPoints {
  std::vector<TexelPoint> points;
  std::vector<int> ends;  ///< of each texel: where its points end
};

/// Integrals of spherical harmonics up to the degree over a texel are exact to about 1e-7 of its solid angle;
/// over one that the rim of a disc cuts, to 1e-5 and less the coarser the map is.
class TexelQuadrature {
 public:
  TexelQuadrature(const sphere::AnyParameterization& parameterization, ChartSize size, int degree);

  /// Replaces `row`.
  void of_row(int chart, int y, RowPoints& row) const;

  /// The longest side of a valid texel, radians.
  double longest_side() const;

 private:
  /// Gauss's product rule of so many nodes a side.
  void append_product(const ChartCell& cell, int nodes, std::vector<TexelPoint>& points) const;
  /// Cells until halving them changes little, where a crease goes through a texel or its density bends.
  /// `cell`'s points, by `nodes`, are the last ones from `first` on, and are replaced where they don't
  /// suffice.
  void refine(const ChartCell& cell, int nodes, double tolerance, int depth, std::size_t first,
              std::vector<TexelPoint>& points) const;
  /// Directions of the corners above and below a row.
  void corners(int chart, int y, std::vector<Vec3d>& directions) const;

  const sphere::AnyParameterization p_;
  const ChartSize size_;
  const double waves_;  ///< per radian
  CellLimits limits_;
};

}  // namespace welkin::harmonics
