#pragma once

#include <optional>
#include <vector>

#include "welkin/harmonics/recurrence.h"
#include "welkin/map/map.h"

/// Maps whose rows are latitudes. Internal to harmonics.
///
/// Their harmonics have the pole +Y: axes (z, x, y), so that azimuth is longitude, from +Z toward +X. The
/// integral of Y_lm over a texel is then a factor of its row times one of its column.
namespace welkin::harmonics {

/// How u of a chart is longitude: centre + width (½ − u), radians.
struct Longitudes {
  double centre, width;
  bool around;  ///< all around: width is 2π
};

/// None where rows are no latitudes, or columns no longitudes at even steps.
std::optional<Longitudes> longitudes_of(const sphere::AnyParameterization& parameterization);

/// Of a chart of so many columns and an order m: ∫ cos m(φ − φ_x) over the width of a texel, as a share of
/// the chart's.
double column_factor(const Longitudes& longitudes, int columns, int m);

/// Longitude of a column's centre.
double column_longitude(const Longitudes& longitudes, int columns, int x);

/// Where degree l of order m stands in row factors: order after order, as in Recurrence.
class RowIndex {
 public:
  explicit RowIndex(int degree) : degree_(degree) {}
  std::size_t count() const { return static_cast<std::size_t>((degree_ + 1) * (degree_ + 2) / 2); }
  /// Of l = m.
  std::size_t first(int m) const { return static_cast<std::size_t>(m * (degree_ + 1) - m * (m - 1) / 2); }

 private:
  int degree_;
};

/// ∫ of Q_lm sin^m θ over a row of texels, for m = 0 … degree and l = m … degree.
class RowFactors {
 public:
  RowFactors(const sphere::AnyParameterization& parameterization, ChartSize size, int degree);

  /// RowIndex::count values.
  void of_row(int row, double* out) const;

 private:
  void add_node(double v, double weight, double* out) const;

  sphere::AnyParameterization parameterization_;
  ChartSize size_;
  Recurrence recurrence_;
};

}  // namespace welkin::harmonics
