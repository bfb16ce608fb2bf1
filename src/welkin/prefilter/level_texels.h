#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "welkin/filter/fetch.h"
#include "welkin/prefilter/bright_points.h"
#include "welkin/prefilter/harmonics.h"
#include "welkin/prefilter/sampled_group.h"

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

  /// Some texels of a chart's rows: directions in the source's frame, and where they lie in the grid.
  struct Tile {
    static constexpr std::size_t kMost = 256;
    std::size_t count = 0;
    alignas(64) float x[kMost], y[kMost], z[kMost];
    alignas(64) float at_chart[kMost], at_u[kMost], at_v[kMost];
  };
  /// Where `tile.count` texels lie, from the `first` of the rows from `from` on.
  void aim(int chart, int from, std::size_t first, Tile& tile) const;
  /// Makes these texels. `bright`: the bright points' sums, `stride` from one value to the next; null: to be
  /// summed here.
  void fill(int chart, int from, std::size_t first, const Tile& tile, const float* bright,
            std::size_t stride) const;

  const Map& result() const { return result_; }

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

/// The texels of levels that are summed together.
class GroupTexels {
 public:
  /// All of them refer to what outlives this.
  GroupTexels(const SampledGroup& lobes, std::vector<const LevelTexels*> members, const BrightPoints& bright)
      : lobes_(lobes), members_(std::move(members)), bright_(bright) {}

  /// Fills these rows of a chart, of every member.
  void rows(int chart, int from, int rows) const;

 private:
  const SampledGroup& lobes_;
  std::vector<const LevelTexels*> members_;
  const BrightPoints& bright_;
};

/// The maps of `levels` from their splines; `near`: of each, the grid of a near part, or null. Borders not
/// filled. Throws Cancelled.
std::vector<Map> make_level_texels(const PrefilterPlan::Tables& tables,
                                   const std::vector<HarmonicLevel>& levels, const std::vector<Level>& grids,
                                   const std::vector<const Level*>& near, const BrightPoints& bright,
                                   const Map& source, const Monitor& monitor);

}  // namespace welkin::prefilter
