#include <algorithm>
#include <cstring>

#include "welkin/prefilter/kernels.h"
#include "welkin/prefilter/spline_grid.h"
#include "welkin/prefilter/tables.h"

namespace welkin {
namespace {

using namespace prefilter;

/// Orders of rows, with zeros for the rows past either pole: [order][part][reach + rows + reach].
struct RowOrders {
  RowOrders(int row_count, int reach_rows, int part_count, int last)
      : reach(reach_rows),
        part(row_count + 2 * reach_rows + 8),
        step(part * part_count),
        values(static_cast<std::size_t>(step) * static_cast<std::size_t>(last + 1)) {}

  float* at(int order, int part_index) { return values.data() + order * step + part_index * part + reach; }

  int reach;
  std::ptrdiff_t part, step;
  Buffer values;
};

/// The orders of the masses, up to three channels from `first`.
RowOrders mass_orders(const NearGroup& group, const Moments& moments, int first, int channels, int last,
                      int reach, const Monitor& monitor) {
  RowOrders orders(moments.height, reach, 2 * channels, last);
  for (int m = 0; m <= last; ++m) {
    for (int p = 0; p < 2 * channels; ++p) {
      float* rows = orders.at(m, p);
      std::fill(rows - reach, rows, 0.0f);
      std::fill(rows + moments.height, rows + moments.height + reach + 8, 0.0f);
    }
  }
  parallel_for(
      moments.packs,
      [&](int pack) {
        const std::size_t size = static_cast<std::size_t>(moments.width) * 16;
        Buffer lanes(size), work(size);
        for (int c = 0; c < channels; ++c) {
          std::memcpy(lanes.data(), moments.at(pack, first + c), size * sizeof(float));
          kernels().rows_to_near(group.fft, lanes.data(), work.data(), group.factors.data(), last, pack,
                                 moments.height, orders.step, orders.part, orders.at(0, 2 * c));
        }
      },
      monitor);
  return orders;
}

void convolve(const NearLevel& level, RowOrders& masses, int first, int channels, Level& grid,
              const Monitor& monitor) {
  const int rows = level.field.rows, last = level.field.last;
  RowOrders results(rows, 0, 2 * channels, last);
  parallel_for(
      last + 1,
      [&](int m) {
        kernels().near[channels - 1](level.field, m, masses.at(m, 0), masses.part, results.at(m, 0),
                                     results.part);
      },
      monitor);
  parallel_for(
      rows / 16,
      [&](int pack) {
        const std::size_t size = static_cast<std::size_t>(level.grid.width) * 16;
        Buffer memory(2 * size);
        for (int c = 0; c < channels; ++c) {
          const float* lanes =
              kernels().near_to_rows(level.fft, results.at(0, 2 * c), last, pack, rows, results.step,
                                     results.part, level.turn.data(), memory.data(), memory.data() + size);
          for (int lane = 0; lane < 16; ++lane) {
            store_lane(lanes, lane, grid,
                       grid.chart(0).row((lane < 8 ? 0 : rows / 2) + pack * 8 + lane % 8) + first + c);
          }
        }
      },
      monitor);
}

}  // namespace

std::vector<Level> run_near(const NearGroup& group, const Map& source, const Monitor& monitor) {
  const Moments moments = moments_of(source, group.moments, part_of(monitor, 0, 0.2));
  const Monitor quiet = without_progress(monitor);
  int last = 0, reach = 0;
  std::vector<Level> grids;
  for (const NearLevel& level : group.levels) {
    last = std::max(last, level.field.last);
    reach = std::max(reach, level.field.reach);
    grids.emplace_back(1, level.grid.width, level.grid.height, source.channels());
  }
  for (int first = 0; first < source.channels(); first += 3) {
    const int channels = std::min(3, source.channels() - first);
    RowOrders masses = mass_orders(group, moments, first, channels, last, reach, quiet);
    for (std::size_t i = 0; i < grids.size(); ++i) {
      convolve(group.levels[i], masses, first, channels, grids[i], quiet);
      if (monitor.progress)
        monitor.progress(0.2 + 0.8 * static_cast<double>(i + 1) / static_cast<double>(grids.size()));
    }
  }
  to_splines(grids, quiet);
  return grids;
}

}  // namespace welkin
