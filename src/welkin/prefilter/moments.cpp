#include "welkin/prefilter/moments.h"

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
#include "welkin/prefilter/scatter.h"

namespace welkin::prefilter {
namespace {

using sphere::AnyParameterization;

void spread(const Map& map, const MomentPlan& plan, Moments& moments, const Monitor& monitor) {
  const RowSpread& down = plan.rows[0];
  const ColumnSpread& along = plan.columns[0];
  const ImageView<const float> chart = map.level.chart(0);
  std::vector<float> shares;
  if (moments.reduced) {
    const int group = plan.rows_per_mass;
    for (int row = 0; row < map.height(); ++row) {
      const auto sine = [&](int y) { return std::sin((y + 0.5) * kPi / map.height()); };
      double sum = 0;
      for (int k = 0; k < group; ++k) sum += sine(row / group * group + k);
      shares.push_back(static_cast<float>(sine(row) / (sum * along.columns)));
    }
  }
  const SpreadRows rows{.texels = chart.data,
                        .row_stride = chart.row_stride,
                        .width = map.width(),
                        .channels = map.channels(),
                        .height = plan.height,
                        .first = down.first.data(),
                        .taps = down.taps.data(),
                        .columns = along.columns,
                        .along = along.along.data(),
                        .along_count = static_cast<int>(along.along.size()),
                        .reach = along.reach,
                        .reduced = moments.reduced ? moments.reduced->level.chart(0).data : nullptr,
                        .reduced_stride = moments.reduced ? moments.reduced->level.chart(0).row_stride : 0,
                        .picture_height = map.height(),
                        .shares = shares.data()};
  parallel_for(
      moments.packs,
      [&](int pack) {
        Buffer work(rows.work());
        kernels().spread_rows(rows, pack, moments.at(pack, 0), work.data());
      },
      monitor);
}

/// Whether the map's rows can be spread and transformed as they are.
bool has_plain_rows(const AnyParameterization& source, ChartSize size) {
  return source.spec() == "latlong" && size.width % 2 == 0 && fft_takes(size.width);
}

/// So many rows tell well enough where a sun is for the dim places on whose horizon it stands, however wide
/// the lobe.
constexpr int kSunRows = 450;

/// How many columns of the picture can be one of the masses', a power of two, so that `least` are left.
int columns_per_mass(int width, int least) {
  int columns = 1;
  while (width % (4 * columns) == 0 && width / (2 * columns) >= least) columns *= 2;
  return columns;
}

}  // namespace

Moments::Moments(int w, int h, int n)
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
    // Past a pole the grid goes on down the opposite meridian; equally, that meridian's picture comes over
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

MomentPlan::MomentPlan(const AnyParameterization& source, ChartSize size, int degree) {
  const double texel = mean_texel(source, size);
  const int least = std::max(
      {16, static_cast<int>(1.42 * degree), std::min(kSunRows, static_cast<int>(0.9 * kPi / texel))});
  // Columns far wider than what the lobes resolve are no boxes to be done along the row alone.
  if (!has_plain_rows(source, size) || (degree > size.width && size.height > size.width)) {
    width = fft_length(std::max(2 * least + least / 4, 64));
    height = width / 2;
    return;
  }
  // The picture's own rows and columns, or an even part of them, where they are enough.
  height = size.height;
  while (height % 2 == 0 && height / 2 >= least) height /= 2;
  if (height % 2 != 0 || height < least) height = (std::max(least, 16) + 1) / 2 * 2;
  const int per_mass = columns_per_mass(size.width, 2 * least);
  width = size.width / per_mass;
  // Three points stand for a box within 1e-3 up to an order where they are 2.3/2 radians apart.
  way = degree <= 2.3 * width / (2 * kPi) ? Way::spread_points : Way::spread_boxes;
  rows_per_mass = size.height % height == 0 ? size.height / height : 0;
  rows.emplace_back(size.width, size.height, height);
  // Boxes are columns of the picture: masses of several resolve more orders than the degree.
  assert(way == Way::spread_points || per_mass == 1);
  columns.push_back(way == Way::spread_boxes ? ColumnSpread::boxes() : ColumnSpread(per_mass));
}

MomentPlan MomentPlan::with_rows(const AnyParameterization& source, ChartSize size, int count) {
  MomentPlan plan;
  plan.height = count;
  if (!has_plain_rows(source, size) || size.height > size.width) {
    plan.width = fft_length(2 * count);
    return plan;
  }
  const int per_mass = columns_per_mass(size.width, 3 * count);
  plan.width = size.width / per_mass;
  plan.way = per_mass > 1 ? Way::spread_points : Way::spread_boxes;
  plan.rows.emplace_back(size.width, size.height, count);
  plan.columns.push_back(per_mass > 1 ? ColumnSpread(per_mass) : ColumnSpread::boxes());
  return plan;
}

Moments moments_of(const Map& map, const MomentPlan& plan, const Monitor& monitor) {
  Moments moments(plan.width, plan.height, map.channels());
  moments.boxes = plan.way == MomentPlan::Way::spread_boxes;
  if (plan.reduced) {
    moments.reduced.emplace(map.parameterization, plan.width, plan.height, map.channels());
    moments.reduced->orientation = map.orientation;
  }
  if (plan.way == MomentPlan::Way::scatter) {
    scatter_texels(map, moments, monitor);
  } else {
    spread(map, plan, moments, monitor);
  }
  return moments;
}

}  // namespace welkin::prefilter
