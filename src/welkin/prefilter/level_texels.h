#pragma once

#include <functional>
#include <vector>

#include "welkin/filter/fetch.h"
#include "welkin/prefilter/bright_points.h"
#include "welkin/prefilter/harmonics.h"

namespace welkin::prefilter {

/// Level texels: the grid's spline, and the bright points' exact sums.
class LevelTexels {
 public:
  /// `near`: the grid of a near part, or null. `is_nonnegative`: whether the source is, so that ringing below
  /// 0 is clamped; asked only where there is some.
  LevelTexels(const HarmonicLevel& level, const Level& grid, const Level* near, const BrightPoints& bright,
              const Matrix3& to_source, const std::function<bool()>& is_nonnegative, Map& result)
      : level_(level),
        view_(view_of(grid)),
        near_(near),
        fetch_(fetch_kernels(grid.channels()).b_spline),
        bright_(bright),
        grid_shape_(sphere::AnyParameterization::make("latlong")),
        to_source_(to_source),
        rotated_(!(to_source == Matrix3{})),
        is_nonnegative_(is_nonnegative),
        result_(result),
        weights_(bright.weight) {
    for (float& weight : weights_) weight *= static_cast<float>(level.scale);
  }

  /// Fills these rows of a chart.
  void rows(int chart, int from, int rows) const;

 private:
  void add_bright(const float* x, const float* y, const float* z, float* values, std::size_t count) const;

  const HarmonicLevel& level_;
  LevelView view_;
  const Level* near_;
  Fetch fetch_;
  const BrightPoints& bright_;
  sphere::AnyParameterization grid_shape_;
  Matrix3 to_source_;
  bool rotated_;  ///< to_source_ is not the identity
  const std::function<bool()>& is_nonnegative_;
  Map& result_;
  std::vector<float> weights_;  ///< the bright points', times the lobe's scale
};

}  // namespace welkin::prefilter
