#include "welkin/map/pyramid.h"

#include "welkin/base/error.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "welkin/map/borders.h"

namespace welkin {
namespace {

/// Where the texels of a finer row of `fine` fall in a coarser one of `coarse` = ⌈fine/2⌉: the first of up to
/// three, and how much of each is inside.
struct Overlap {
  int first;
  float share[3];
};

std::vector<Overlap> overlaps(int fine, int coarse) {
  std::vector<Overlap> list(static_cast<std::size_t>(coarse));
  const double step = static_cast<double>(fine) / coarse;
  for (int i = 0; i < coarse; ++i) {
    const double from = i * step, to = (i + 1) * step;
    Overlap& each = list[static_cast<std::size_t>(i)];
    each.first = std::min(static_cast<int>(from + 1e-9), fine - 1);
    for (int k = 0; k < 3; ++k) {
      const double low = std::max<double>(from, each.first + k),
                   high = std::min<double>(to, each.first + k + 1);
      each.share[k] = each.first + k < fine ? static_cast<float>(std::max(0.0, high - low)) : 0.0f;
    }
  }
  return list;
}

/// One row of the coarser level where both sides of the finer are even and all texels of a row weigh the
/// same. `C` channels, known at compile time so that the loop is a few vector instructions.
template <int C>
void reduce_uniform_row(const float* above, const float* below, float weight_above, float weight_below,
                        int width, float* out) {
  for (int x = 0; x < width; ++x) {
    for (int c = 0; c < C; ++c) {
      out[c] = weight_above * (above[c] + above[C + c]) + weight_below * (below[c] + below[C + c]);
    }
    above += 2 * C;
    below += 2 * C;
    out += C;
  }
}

}  // namespace

Level reduce(const sphere::AnyParameterization& parameterization, const Level& finer, TexelWeight weight) {
  require(finer.charts() == parameterization.charts(),
          "a level has another number of charts than its parameterization");
  const int width = (finer.width() + 1) / 2, height = (finer.height() + 1) / 2, channels = finer.channels();
  Level coarser(finer.charts(), width, height, channels);
  const std::vector<Overlap> columns = overlaps(finer.width(), width),
                             rows = overlaps(finer.height(), height);
  const bool even = finer.width() % 2 == 0 && finer.height() % 2 == 0;
  const bool uniform = even && (weight == TexelWeight::equal || parameterization.density_by_row()) &&
                       parameterization.full_charts();

  const auto reduce_row = [&](int chart, int y, std::vector<float>& weights) {
    const ImageView<const float> from = finer.chart(chart);
    float* out = coarser.chart(chart).row(y);
    const std::size_t fine_width = static_cast<std::size_t>(finer.width());
    weights.resize(3 * fine_width);
    const Overlap& vertical = rows[static_cast<std::size_t>(y)];
    for (int k = 0; k < 3; ++k) {
      float* row = weights.data() + static_cast<std::size_t>(k) * fine_width;
      if (!(vertical.share[k] > 0)) continue;
      texel_solid_angles(parameterization, finer.width(), finer.height(), chart, vertical.first + k, row);
      if (weight == TexelWeight::equal) {
        std::transform(row, row + fine_width, row, [](float w) { return w > 0 ? 1.0f : 0.0f; });
      }
    }
    if (uniform && channels <= 4) {
      const float* above = from.row(2 * y);
      const float* below = from.row(2 * y + 1);
      const float wa = weights[0], wb = weights[fine_width];
      const float scale = 0.5f / (wa + wb);
      switch (channels) {
        case 1:
          return reduce_uniform_row<1>(above, below, wa * scale, wb * scale, width, out);
        case 2:
          return reduce_uniform_row<2>(above, below, wa * scale, wb * scale, width, out);
        case 3:
          return reduce_uniform_row<3>(above, below, wa * scale, wb * scale, width, out);
        default:
          return reduce_uniform_row<4>(above, below, wa * scale, wb * scale, width, out);
      }
    }
    for (int x = 0; x < width; ++x, out += channels) {
      const Overlap& horizontal = columns[static_cast<std::size_t>(x)];
      float total = 0;
      std::fill_n(out, channels, 0.0f);
      for (int j = 0; j < 3; ++j) {
        if (!(vertical.share[j] > 0)) continue;
        for (int i = 0; i < 3; ++i) {
          if (!(horizontal.share[i] > 0)) continue;
          const float w = vertical.share[j] * horizontal.share[i] *
                          weights[static_cast<std::size_t>(j) * fine_width +
                                  static_cast<std::size_t>(horizontal.first + i)];
          if (!(w > 0)) continue;
          const float* texel = from.at(horizontal.first + i, vertical.first + j);
          total += w;
          for (int c = 0; c < channels; ++c) out[c] += w * texel[c];
        }
      }
      if (total > 0) {
        for (int c = 0; c < channels; ++c) out[c] /= total;
      }
    }
  };

  tbb::parallel_for(tbb::blocked_range<int>(0, finer.charts() * height, 4), [&](const auto& range) {
    std::vector<float> weights;
    for (int i = range.begin(); i != range.end(); ++i) reduce_row(i / height, i % height, weights);
  });
  fill_borders(parameterization, coarser, RimTexels::kept);
  return coarser;
}

int levels_below(int width, int height) {
  int levels = 0;
  while (width > 1 || height > 1) {
    width = (width + 1) / 2;
    height = (height + 1) / 2;
    ++levels;
  }
  return levels;
}

std::vector<Level> make_pyramid(const Map& map, int levels, TexelWeight weight) {
  std::vector<Level> pyramid;
  levels = std::min(levels, levels_below(map.width(), map.height()));
  for (int i = 0; i < levels; ++i) {
    pyramid.push_back(reduce(map.parameterization, i == 0 ? map.level : pyramid.back(), weight));
  }
  return pyramid;
}

}  // namespace welkin
