#include "welkin/prefilter/near.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "welkin/base/parallel.h"
#include "welkin/prefilter/harmonics.h"
#include "welkin/prefilter/kernels.h"
#include "welkin/prefilter/spline_grid.h"

namespace welkin::prefilter {
namespace {

/// Packs [first, end) of the result's rows, all steps in one piece of work, which stays in the cache.
class Band {
 public:
  Band(const NearGroup& group, const PointGrid& points, int first, int end)
      : group_(group), points_(points), first_(first), end_(end) {
    for (const NearLevel& level : group.levels) {
      last_ = std::max(last_, level.field.last);
      reach_ = std::max(reach_, level.field.reach);
    }
    margin_ = (reach_ + 7) / 8;
  }

  /// Up to three channels from `channel`.
  void run(int channel, int channels, std::vector<Level>& grids) {
    take_orders(channel, channels);
    for (std::size_t i = 0; i < grids.size(); ++i) fill(group_.levels[i], channel, channels, grids[i]);
  }

 private:
  /// The orders of the points of these rows and of those that they reach: [order][part][half][row].
  void take_orders(int channel, int channels) {
    const int rows = (end_ - first_ + 2 * margin_) * 8, beside = margin_ * 8;
    orders_ = {nullptr, 4 * static_cast<std::ptrdiff_t>(rows) * channels,
               2 * static_cast<std::ptrdiff_t>(rows), rows};
    values_ = Buffer(static_cast<std::size_t>(orders_.order) * static_cast<std::size_t>(last_ + 1));
    orders_.values = values_.data() + beside;
    const std::size_t size = static_cast<std::size_t>(points_.width) * 16;
    Buffer lanes(2 * size);
    for (int pack = std::max(0, first_ - margin_); pack < std::min(end_ + margin_, points_.packs); ++pack) {
      for (int c = 0; c < channels; ++c) {
        NearOrders to = orders_;
        to.values += (pack - first_) * 8 + 2 * c * orders_.part;
        std::memcpy(lanes.data(), points_.at(pack, channel + c), size * sizeof(float));
        kernels().rows_to_near(group_.fft, lanes.data(), lanes.data() + size, group_.factors.data(), last_,
                               to);
      }
    }
    // Past the pole there is nothing; past the equator rows go on in the other half.
    for (int m = 0; m <= last_; ++m) {
      for (int part = 0; part < 4 * channels; ++part) {
        float* row = orders_.values + m * orders_.order + part * orders_.half;
        float* other = part % 2 == 0 ? row + orders_.half : row - orders_.half;
        for (int pack = first_ - margin_; pack < 0; ++pack) std::fill_n(row + (pack - first_) * 8, 8, 0.0f);
        const std::ptrdiff_t equator = (points_.packs - first_) * 8;
        for (std::ptrdiff_t past = 0; equator + past < (end_ - first_) * 8 + beside; ++past) {
          row[equator + past] = other[equator - 1 - past];
        }
      }
    }
  }

  void fill(const NearLevel& level, int channel, int channels, Level& grid) const {
    const std::ptrdiff_t size = static_cast<std::ptrdiff_t>(level.grid.width) * 16;
    Buffer lanes(static_cast<std::size_t>(size * ((end_ - first_) * channels + 1)));
    const auto at = [&](int pack, int c) { return lanes.data() + ((pack - first_) * channels + c) * size; };
    for (int pack = first_; pack < end_; ++pack) {
      const int last = level.field.packs[static_cast<std::size_t>(pack)].last;
      for (int c = 0; c < channels; ++c) {
        std::fill(at(pack, c) + (last + 1) * 16, at(pack, c) + (level.grid.width - last) * 16, 0.0f);
      }
    }
    // One order of all packs after the other: their rows of points overlap.
    for (int m = 0; m <= level.field.last; ++m) {
      for (int pack = first_; pack < end_; ++pack) {
        if (m > level.field.packs[static_cast<std::size_t>(pack)].last) continue;
        NearOrders points = orders_;
        points.values += (pack - first_) * 8;
        kernels().near[channels - 1](level.field, pack, m, points,
                                     {at(pack, 0), size, level.grid.width, level.phases.data()});
      }
    }
    for (int pack = first_; pack < end_; ++pack) {
      for (int c = 0; c < channels; ++c) {
        const float* rows = kernels().to_rows(level.fft, at(pack, c), at(end_, 0));
        std::array<float*, 16> to;
        for (int lane = 0; lane < 16; ++lane) {
          const int north = pack * 8 + lane % 8;
          to[static_cast<std::size_t>(lane)] =
              grid.chart(0).row(lane < 8 ? north : level.grid.height - 1 - north) + channel + c;
        }
        store_lanes(rows, to, grid);
      }
    }
  }

  const NearGroup& group_;
  const PointGrid& points_;
  int first_, end_;
  int last_ = 0, reach_ = 0, margin_ = 0;  ///< the margin in packs
  Buffer values_;
  NearOrders orders_{};
};

}  // namespace

NearLevel::NearLevel(const WidenedLobe& widened, std::size_t number, int rows, int degree, double tolerance,
                     int points_width)
    : harmonic(number),
      field(widened.lobe, widened.zonal, rows, degree, tolerance),
      grid{fft_length(std::max(2 * rows, 2 * field.last + 4)), rows},
      fft(grid.width),
      phases(prefilter::phases(field.last, grid.width, points_width)) {}

NearGroup::NearGroup(const PrefilterShape& source, int rows, int last_order)
    : points(PointGridPlan::with_rows(source.parameterization, source.size, rows)),
      fft(points.width),
      factors(order_factors(points, last_order)) {}

std::vector<Level> run_near(const NearGroup& group, const Map& source, const Monitor& monitor) {
  const PointGrid points = make_point_grid(source, group.points, part_of(monitor, 0, 0.2));
  std::vector<Level> grids;
  for (const NearLevel& level : group.levels) {
    grids.emplace_back(1, level.grid.width, level.grid.height, source.channels(), PixelContents::unset);
  }
  constexpr int kPacks = 8;
  const int bands = (points.packs + kPacks - 1) / kPacks, groups = (source.channels() + 2) / 3;
  parallel_for(
      bands * groups,
      [&](int i) {
        const int first = i / groups * kPacks, channel = i % groups * 3;
        Band(group, points, first, std::min(first + kPacks, points.packs))
            .run(channel, std::min(3, source.channels() - channel), grids);
      },
      part_of(monitor, 0.2, 0.9));
  to_splines(grids, part_of(monitor, 0.9, 1));
  return grids;
}

}  // namespace welkin::prefilter
