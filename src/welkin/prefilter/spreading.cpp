#include "welkin/prefilter/spreading.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include "welkin/base/error.h"
#include "welkin/base/large_memory.h"
#include "welkin/base/parallel.h"
#include "welkin/map/texel_points.h"
#include "welkin/prefilter/lagrange.h"

namespace welkin::prefilter {
namespace {

using sphere::AnyParameterization;

/// Radiance spread from any position onto a grid (the step of a type-1 non-uniform transform) that has three
/// rows and columns more on every side, folded in at the end.
class SpreadSums {
 public:
  SpreadSums(int width, int height, int channels)
      : width_(width),
        height_(height),
        channels_(padded(channels)),
        stride_(static_cast<std::size_t>(width + 2 * kMargin) * static_cast<std::size_t>(channels_)),
        memory_((stride_ * static_cast<std::size_t>(height + 2 * kMargin)) * sizeof(float),
                LargeMemory::Contents::zero),
        weights_(reinterpret_cast<float*>(memory_.data())) {}

  /// Four values at a time: `radiance` has room for that.
  static constexpr int padded(int channels) { return (channels + 3) / 4 * 4; }

  /// `radiance` (one value per channel, padded with anything finite) times `weight`, a solid angle, at u, v
  /// of the grid's picture: spread over 6×6 points by the weights of Lagrange interpolation of degree five
  /// there.
  void add(float u, float v, const float* radiance, float weight) {
    const float x = u * static_cast<float>(width_) - 0.5f, y = v * static_cast<float>(height_) - 0.5f;
    // x and y are above −2: truncating rounds down.
    const int left = static_cast<int>(x + 2) - 2, top = static_cast<int>(y + 2) - 2;
    float wx[6], wy[6];
    lagrange6(x - static_cast<float>(left), wx);
    lagrange6(y - static_cast<float>(top), wy);
    const int column = std::clamp(left, -1, width_ - 1) - 2 + kMargin;
    const int row = std::clamp(top, -1, height_ - 1) - 2 + kMargin;
    float* to = weights_ + static_cast<std::size_t>(row) * stride_ +
                static_cast<std::size_t>(column) * static_cast<std::size_t>(channels_);
    for (int first = 0; first < channels_; first += 4) {
      float part[4];
      for (int c = 0; c < 4; ++c) part[c] = weight * radiance[first + c];
      for (int j = 0; j < 6; ++j) {
        float* at = to + static_cast<std::size_t>(j) * stride_ + first;
        for (int i = 0; i < 6; ++i, at += channels_) {
          const float w = wy[j] * wx[i];
          for (int c = 0; c < 4; ++c) at[c] += w * part[c];
        }
      }
    }
  }

  /// Adds what lies past the edges to the points it wraps to: left and right go around, and past a pole the
  /// rows continue down the opposite meridian.
  void fold() {
    const int half = width_ / 2;
    for (int y = -kMargin; y < height_ + kMargin; ++y) {
      for (int x = -kMargin; x < 0; ++x) move(x, y, x + width_, y);
      for (int x = width_; x < width_ + kMargin; ++x) move(x, y, x - width_, y);
    }
    for (int y = -kMargin; y < 0; ++y) {
      for (int x = 0; x < width_; ++x) {
        move(x, y, (x + half) % width_, -1 - y);
        move(x, height_ - 1 - y, (x + half) % width_, height_ + y);
      }
    }
  }

  float* row(int y) { return at(0, y); }

 private:
  static constexpr int kMargin = 3;

  float* at(int x, int y) {
    return weights_ + static_cast<std::size_t>(y + kMargin) * stride_ +
           static_cast<std::size_t>((x + kMargin) * channels_);
  }
  void move(int x, int y, int to_x, int to_y) {
    float *from = at(x, y), *to = at(to_x, to_y);
    for (int c = 0; c < channels_; ++c) {
      to[c] += from[c];
      from[c] = 0;
    }
  }

  int width_, height_, channels_;
  std::size_t stride_;
  LargeMemory memory_;
  float* weights_;
};

/// A batch of points on their way to the grid. Directions needn't be of length 1.
struct Points {
  static constexpr std::size_t kMax = 256;
  explicit Points(std::size_t filled) : count(filled) {
    for (float* each : {x, y, z, weight}) std::fill(each, each + sphere::padded(count), 0.0f);
  }
  /// Merges a point of weight w into point i: the weighted sum of directions, and of weights.
  void merge(std::size_t i, float px, float py, float pz, float w) {
    x[i] += w * px;
    y[i] += w * py;
    z[i] += w * pz;
    weight[i] += w;
  }
  alignas(64) float x[kMax], y[kMax], z[kMax], weight[kMax];
  std::size_t count;
};

/// How many cells a texel is cut into so that none is wider than a step of the grid. 0 × 0: it is so small
/// that one point suffices.
struct Cells {
  int across = 0, down = 0;
  friend bool operator==(const Cells&, const Cells&) = default;
  friend bool operator<(const Cells& a, const Cells& b) {
    return std::tie(a.across, a.down) < std::tie(b.across, b.down);
  }
};

/// Spreads rows of any map.
class TexelSpreader {
 public:
  TexelSpreader(const Map& map, int height)
      : map_(map),
        size_{map.width(), map.height()},
        grid_(AnyParameterization::make("latlong")),
        step_(static_cast<float>(kPi / height)) {}

  void row(int chart, int y, SpreadSums& sums) const {
    const std::vector<TexelKind> kinds = texel_kinds(map_.parameterization, size_, chart, y);
    std::vector<Texel> texels;
    for (int x = 0; x < size_.width; ++x) {
      const TexelKind kind = kinds[static_cast<std::size_t>(x)];
      if (kind != TexelKind::outside) texels.push_back({x, {}, kind == TexelKind::plain});
    }
    for (std::size_t from = 0; from < texels.size(); from += Points::kMax) {
      choose_cells(chart, y, std::span(texels).subspan(from, std::min(Points::kMax, texels.size() - from)));
    }
    const auto irregular_ones =
        std::stable_partition(texels.begin(), texels.end(), [](const Texel& texel) { return texel.plain; });
    std::stable_sort(texels.begin(), irregular_ones,
                     [](const Texel& a, const Texel& b) { return a.cells < b.cells; });
    for (auto from = texels.begin(); from != irregular_ones;) {
      const auto limit = from + std::min<std::ptrdiff_t>(Points::kMax, irregular_ones - from);
      const auto to =
          std::find_if(from, limit, [&](const Texel& each) { return !(each.cells == from->cells); });
      add_plain(chart, y, {from, to}, sums);
      from = to;
    }
    for (auto each = irregular_ones; each != texels.end(); ++each) add_irregular(chart, y, *each, sums);
  }

 private:
  struct Texel {
    int x;
    Cells cells;
    bool plain;
  };

  /// u and v of one position, the same in each, of a batch of texels.
  struct Positions {
    Positions(ChartSize size, int row, std::span<const Texel> texels, double across, double down) {
      for (std::size_t i = 0; i < sphere::padded(texels.size()); ++i) {
        u[i] = static_cast<float>((texels[std::min(i, texels.size() - 1)].x + across) / size.width);
        v[i] = static_cast<float>((row + down) / size.height);
      }
    }
    alignas(64) float u[Points::kMax], v[Points::kMax];
  };

  Points points_at(int chart, const Positions& positions, std::size_t count) const {
    const AnyParameterization& p = map_.parameterization;
    Points points(count);
    p.kernels().to_sphere(p.self(), chart, positions.u, positions.v, points.x, points.y, points.z, count);
    return points;
  }

  /// By twice the longer half of the texel, across and down. Rounded so that neighbours have the same. A long
  /// texel of small solid angle isn't plain: its cells would be far too many.
  void choose_cells(int chart, int row, std::span<Texel> texels) const {
    const auto at = [&](double across, double down) {
      return points_at(chart, Positions(size_, row, texels, across, down), texels.size());
    };
    const Points middle = at(0.5, 0.5);
    const auto longer = [&](const Points& a, const Points& b, std::size_t i) {
      const auto half = [&](const Points& edge) {
        const float x = edge.x[i] - middle.x[i], y = edge.y[i] - middle.y[i], z = edge.z[i] - middle.z[i];
        return std::sqrt(x * x + y * y + z * z);
      };
      return 2 * std::max(half(a), half(b));
    };
    const auto cells_of = [&](float side) {
      int cells = 1;
      while (static_cast<float>(cells) * step_ * 1.001f < side) cells += (cells + 3) / 4;
      return cells;
    };
    const Points left = at(0, 0.5), right = at(1, 0.5), top = at(0.5, 0), bottom = at(0.5, 1);
    const AnyParameterization& p = map_.parameterization;
    alignas(64) float density[Points::kMax];
    const Positions middles(size_, row, texels, 0.5, 0.5);
    p.kernels().density(p.self(), chart, middles.u, middles.v, density, texels.size());
    const float cell_area =
        step_ * step_ * static_cast<float>(size_.width) * static_cast<float>(size_.height);
    for (std::size_t i = 0; i < texels.size(); ++i) {
      const float across = longer(left, right, i), down = longer(top, bottom, i);
      if (std::max(across, down) < step_ / 6) continue;
      Cells& cells = texels[i].cells;
      cells = {cells_of(across), cells_of(down)};
      if (static_cast<float>(cells.across * cells.down) > 4 + 4 * density[i] / cell_area)
        texels[i].plain = false;
    }
  }

  /// Two of Gauss's points along and down each cell of texels that have the same cells.
  void add_plain(int chart, int row, std::span<const Texel> texels, SpreadSums& sums) const {
    const AnyParameterization& p = map_.parameterization;
    const Cells cells = texels[0].cells;
    const int across = std::max(1, cells.across), down = std::max(1, cells.down);
    const std::size_t count = texels.size();
    const float area =
        static_cast<float>(1 / (4.0 * across * down * static_cast<double>(size_.width) * size_.height));
    Points together(count);
    alignas(64) float density[Points::kMax];
    for (int k = 0; k < 4 * across * down; ++k) {
      const Positions positions(size_, row, texels, (k / 4 % across + kGauss[k % 2]) / across,
                                (k / 4 / across + kGauss[k / 2 % 2]) / down);
      Points points = points_at(chart, positions, count);
      p.kernels().density(p.self(), chart, positions.u, positions.v, density, count);
      for (std::size_t i = 0; i < count; ++i) points.weight[i] = density[i] * area;
      if (cells.across > 0) {
        add(points, chart, row, texels, sums);
        continue;
      }
      for (std::size_t i = 0; i < count; ++i) {
        together.merge(i, points.x[i], points.y[i], points.z[i], points.weight[i]);
      }
    }
    if (cells.across == 0) add(together, chart, row, texels, sums);
  }

  /// What the texel covers, by many points, each merged with the one before while they are close together.
  void add_irregular(int chart, int row, const Texel& texel, SpreadSums& sums) const {
    CellLimits limits = texel_limits(map_.parameterization, size_);
    limits.side = static_cast<double>(step_);
    std::vector<TexelPoint> exact;
    append_points(map_.parameterization, texel_cell(size_, chart, texel.x, row), limits, exact);
    for (std::size_t i = 0; i < exact.size();) {
      Points points(Points::kMax);
      points.count = 0;
      for (; points.count < Points::kMax && i < exact.size(); ++points.count) {
        const Vec3d first = exact[i].direction;
        do {
          const Vec3d d = exact[i].direction;
          points.merge(points.count, static_cast<float>(d.x), static_cast<float>(d.y),
                       static_cast<float>(d.z), static_cast<float>(exact[i].solid_angle));
          ++i;
        } while (i < exact.size() && length(exact[i].direction - first) <= limits.side / 4);
      }
      add(points, chart, row, {&texel, 1}, sums);
    }
  }

  /// Spreads the texels' radiance from one point of each, or one texel's at all of them.
  void add(const Points& points, int chart, int row, std::span<const Texel> texels, SpreadSums& sums) const {
    alignas(64) float to_chart[Points::kMax], u[Points::kMax], v[Points::kMax];
    grid_.kernels().from_sphere(grid_.self(), points.x, points.y, points.z, to_chart, u, v, points.count);
    for (std::size_t i = 0; i < points.count; ++i) {
      // Past the last channel a texel's neighbour or border is read: any values will do.
      const int x = texels[std::min(i, texels.size() - 1)].x;
      if (points.weight[i] > 0) sums.add(u[i], v[i], map_.level.chart(chart).at(x, row), points.weight[i]);
    }
  }

  const Map& map_;
  ChartSize size_;
  AnyParameterization grid_;
  float step_;  ///< of the grid, radians
};

}  // namespace

void spread_texels(const Map& map, PointGrid& grid, const Monitor& monitor) {
  const int width = grid.width, height = grid.height, n = grid.channels;
  const TexelSpreader spreader(map, height);
  const int rows = map.charts() * map.height();
  // The number of sums doesn't depend on the number of threads, so neither do the sums.
  const int slices = std::min(8, rows);
  std::vector<std::optional<SpreadSums>> sums(static_cast<std::size_t>(slices));
  parallel_for(
      slices,
      [&](int slice) {
        const auto first = [&](int i) {
          return static_cast<int>(static_cast<std::int64_t>(rows) * i / slices);
        };
        SpreadSums& own = sums[static_cast<std::size_t>(slice)].emplace(width, height, n);
        for (int row = first(slice); row < first(slice + 1); ++row) {
          if (monitor.cancelled && monitor.cancelled()) throw Cancelled();
          spreader.row(row / map.height(), row % map.height(), own);
        }
        own.fold();
      },
      monitor);
  parallel_for(grid.packs, [&](int pack) {
    for (int lane = 0; lane < 16; ++lane) {
      const int north = pack * 8 + lane % 8, y = lane < 8 ? north : height - 1 - north;
      for (int c = 0; c < n; ++c) {
        float* to = grid.at(pack, c) + lane;
        for (int x = 0; x < width; ++x) to[x * 16] = 0;
        if (north >= height / 2) continue;
        for (auto& each : sums) {
          const float* from = each->row(y) + c;
          for (int x = 0; x < width; ++x) to[x * 16] += from[x * SpreadSums::padded(n)];
        }
      }
    }
  });
}

}  // namespace welkin::prefilter
