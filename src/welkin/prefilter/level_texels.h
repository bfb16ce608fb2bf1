#pragma once

#include <functional>
#include <vector>

#include "welkin/filter/fetch.h"
#include "welkin/prefilter/bright_points.h"
#include "welkin/prefilter/tables.h"

namespace welkin {

/// Level texels: the grid's spline, and the bright points' exact sums.
class LevelTexels {
 public:
  /// `near`: the grid of a near part, or null.
  LevelTexels(const HarmonicLevel& level, const Level& grid, const Level* near,
              const prefilter::BrightPoints& bright, const Matrix3& to_source,
              const std::function<bool()>& hold_positive, Map& result)
      : level_(level),
        view_(view_of(grid)),
        near_(near),
        fetch_(fetch_kernels(grid.channels()).b_spline),
        bright_(bright),
        grid_shape_(sphere::AnyParameterization::make("latlong")),
        to_source_(to_source),
        turned_(!(to_source == Matrix3{})),
        hold_positive_(hold_positive),
        result_(result),
        masses_(bright.mass) {
    for (float& mass : masses_) mass *= static_cast<float>(level.scale);
  }

  /// Fills these rows of a chart.
  void rows(int chart, int from, int rows) const;

 private:
  void add_bright(const float* x, const float* y, const float* z, float* values, std::size_t count) const;

  const HarmonicLevel& level_;
  LevelView view_;
  const Level* near_;
  Fetch fetch_;
  const prefilter::BrightPoints& bright_;
  sphere::AnyParameterization grid_shape_;
  Matrix3 to_source_;
  bool turned_;  ///< to_source_ is not the identity
  const std::function<bool()>& hold_positive_;
  Map& result_;
  std::vector<float> masses_;  ///< the bright points', times the lobe's scale
};

}  // namespace welkin
