#include "welkin/prefilter/point_grid.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "welkin/base/parallel.h"
#include "welkin/lobe/panels.h"
#include "welkin/map/texel_points.h"
#include "welkin/math/gauss_legendre.h"
#include "welkin/prefilter/fft.h"
#include "welkin/prefilter/kernels.h"
#include "welkin/prefilter/lagrange.h"
#include "welkin/prefilter/spreading.h"

namespace welkin::prefilter {
namespace {

using sphere::AnyParameterization;

void spread_rows(const Map& map, const PointGridPlan& plan, RowValues* values, PointGrid& grid,
                 const Monitor& monitor) {
  const SpreadRows rows{map.level.chart(0), *plan.rows, *plan.columns, values};
  parallel_for(
      grid.packs,
      [&](int pack) {
        Buffer work(rows.work());
        kernels().spread_rows(rows, pack, grid.at(pack, 0), work.data());
      },
      monitor);
}

/// Whether the map's rows can be spread and transformed as they are.
bool has_plain_rows(const AnyParameterization& source, ChartSize size) {
  return source.traits().latlong_grid && size.width % 2 == 0 && fft_takes(size.width);
}

/// So many rows locate a sun precisely enough for dark directions that have it on their horizon, however wide
/// the lobe.
constexpr int kSunRows = 450;

/// How many columns of the picture can be one of the grid's, a power of two, so that `minimum` are left.
int columns_per_point(int width, int minimum) {
  int columns = 1;
  while (width % (4 * columns) == 0 && width / (2 * columns) >= minimum) columns *= 2;
  return columns;
}

}  // namespace

PointGrid::PointGrid(int w, int h, int n)
    : width(w),
      height(h),
      channels(n),
      packs((h / 2 + 7) / 8),
      lanes(static_cast<std::size_t>(packs) * static_cast<std::size_t>(n) * static_cast<std::size_t>(w) *
            16) {
  assert(h % 2 == 0);
}

RowSpread::RowSpread(int columns, int picture_rows, int rows) {
  const QuadratureRule rule = gauss_legendre(4);
  std::vector<std::vector<Tap>> lists(static_cast<std::size_t>(rows));
  const auto add = [&](int to, int from, double weight) {
    // Past a pole the grid continues down the opposite meridian; equally, that meridian's picture comes over
    // the pole.
    const bool opposite = to < 0 || to >= rows;
    if (to < 0) to = -1 - to;
    if (to >= rows) to = 2 * rows - 1 - to;
    to = std::clamp(to, 0, rows - 1);
    std::vector<Tap>& list = lists[static_cast<std::size_t>(to)];
    for (Tap& tap : list) {
      if (tap.row == from && tap.opposite == opposite) {
        tap.weight += static_cast<float>(weight);
        return;
      }
    }
    list.push_back({from, opposite, static_cast<float>(weight)});
  };
  const double step = kPi / rows, scale = static_cast<double>(rows) / picture_rows;
  std::vector<double> sums;
  for (int row = 0; row < picture_rows; ++row) {
    // In steps of the grid, whose nodes lie at whole numbers and a half. Between two nodes all is one
    // polynomial.
    const double begin = row * scale, end = (row + 1) * scale;
    const int first = static_cast<int>(std::floor(begin - 0.5)) - 2;
    sums.assign(static_cast<std::size_t>(static_cast<int>(std::ceil(end)) + 4 - first), 0.0);
    for (double from = begin; from < end - 1e-12;) {
      const double node = std::floor(from - 0.5 + 1e-12) + 0.5;
      const double to = std::min(end, node + 1);
      for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
        const double y = (from + to) / 2 + rule.nodes[k] * (to - from) / 2;
        double w[6];
        lagrange6(y - node, w);
        const double measure =
            std::sin(y * step) * step * (to - from) / 2 * rule.weights[k] * 2 * kPi / columns;
        for (int j = 0; j < 6; ++j) {
          sums[static_cast<std::size_t>(static_cast<int>(node - 0.5) - 2 + j - first)] += measure * w[j];
        }
      }
      from = to;
    }
    for (std::size_t j = 0; j < sums.size(); ++j) {
      if (sums[j] != 0) add(first + static_cast<int>(j), row, sums[j]);
    }
  }
  for (const std::vector<Tap>& list : lists) {
    first.push_back(static_cast<int>(taps.size()));
    taps.insert(taps.end(), list.begin(), list.end());
  }
  first.push_back(static_cast<int>(taps.size()));
}

ColumnSpread::ColumnSpread(int count) : columns(count) {
  if (columns == 1) {
    reach = 1;
    along = {1.0f / 24, 22.0f / 24, 1.0f / 24};
    return;
  }
  // The cubic Lagrange kernel, two columns to either side of a column's middle, averaged over each texel by
  // Gauss's rule of three points. A texel lies at (i + ½)/columns − ½ from the middle of the column that
  // holds it.
  const auto kernel = [](double x) {
    x = std::fabs(x);
    if (x < 1) return (1 - x) * (1 + x) * (2 - x) / 2;
    return x < 2 ? (1 - x) * (2 - x) * (3 - x) / 6 : 0.0;
  };
  const QuadratureRule rule = gauss_legendre(3);
  reach = (3 * columns + 1) / 2;
  for (int i = -reach; i < columns + reach; ++i) {
    const double middle = (i + 0.5) / columns - 0.5, half = 0.5 / columns;
    // A texel in the middle of an even number of columns can straddle a kink of the kernel: each half by
    // itself.
    double sum = 0;
    for (double side : {-0.5, 0.5}) {
      for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
        sum += rule.weights[k] / 4 * kernel(middle + side * half + rule.nodes[k] * half / 2);
      }
    }
    along.push_back(static_cast<float>(sum));
  }
}

ColumnSpread ColumnSpread::boxes() {
  ColumnSpread spread(1);
  spread.reach = 0;
  spread.along = {1.0f};
  return spread;
}

PointGridPlan::PointGridPlan(const AnyParameterization& source, ChartSize size, int degree, Rows use) {
  const double texel = mean_texel(source, size);
  const int sun_rows = use == Rows::locate_suns ? std::min(kSunRows, static_cast<int>(0.9 * kPi / texel)) : 0;
  const int minimum = std::max({16, static_cast<int>(1.42 * degree), sun_rows});
  // Columns far wider than what the lobes resolve can't be treated as boxes along the row alone.
  if (!has_plain_rows(source, size) || (degree > size.width && size.height > size.width)) {
    width = fft_length(std::max(2 * minimum + minimum / 4, 64));
    height = width / 2;
    return;
  }
  // The picture's own rows and columns, or an even part of them, where they are enough.
  height = size.height;
  while (height % 2 == 0 && height / 2 >= minimum) height /= 2;
  if (height % 2 != 0 || height < minimum) height = (std::max(minimum, 16) + 1) / 2 * 2;
  const int per_point = columns_per_point(size.width, 2 * minimum);
  width = size.width / per_point;
  // Three points differ from a box by φ⁴/339 at a phase of φ to a column: up to 2.3 at the last order, where
  // the lobe has least.
  way = degree <= 2.3 * width / (2 * kPi) ? Way::spread_points : Way::spread_boxes;
  rows.emplace(size.width, size.height, height);
  // Boxes are columns of the picture: points of several resolve more orders than the degree.
  assert(way == Way::spread_points || per_point == 1);
  columns = way == Way::spread_boxes ? ColumnSpread::boxes() : ColumnSpread(per_point);
}

PointGridPlan PointGridPlan::with_rows(const AnyParameterization& source, ChartSize size, int count) {
  PointGridPlan plan;
  plan.height = count;
  if (!has_plain_rows(source, size) || size.height > size.width) {
    plan.width = fft_length(2 * count);
    return plan;
  }
  const int per_point = columns_per_point(size.width, 3 * count);
  plan.width = size.width / per_point;
  plan.way = per_point > 1 ? Way::spread_points : Way::spread_boxes;
  plan.rows.emplace(size.width, size.height, count);
  plan.columns = per_point > 1 ? ColumnSpread(per_point) : ColumnSpread::boxes();
  return plan;
}

PointGrid make_point_grid(const Map& map, const PointGridPlan& plan, const Monitor& monitor) {
  PointGrid grid(plan.width, plan.height, map.channels());
  grid.boxes = plan.way == PointGridPlan::Way::spread_boxes;
  if (plan.way == PointGridPlan::Way::spread_texels) {
    spread_texels(map, grid, monitor);
  } else {
    spread_rows(map, plan, nullptr, grid, monitor);
  }
  return grid;
}

PointGrid make_point_grid(const Map& map, const PointGridPlan& plan, std::span<RowValues> values,
                          const Monitor& monitor) {
  assert(plan.rows && values.size() == static_cast<std::size_t>(map.height()));
  assert(map.height() % plan.height == 0 && map.channels() <= RowValues::kMostChannels);
  PointGrid grid(plan.width, plan.height, map.channels());
  grid.boxes = plan.way == PointGridPlan::Way::spread_boxes;
  spread_rows(map, plan, values.data(), grid, monitor);
  return grid;
}

}  // namespace welkin::prefilter
