#include "welkin/prefilter/scatter.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "welkin/prefilter/lagrange.h"

namespace welkin::prefilter {
namespace {

using sphere::AnyParameterization;

/// Masses deposited at any place: a grid with three rows and columns more on every side, folded in at the
/// end.
class Deposit {
 public:
  Deposit(int width, int height, int channels)
      : width_(width),
        height_(height),
        channels_(padded(channels)),
        stride_(static_cast<std::size_t>(width + 2 * kMargin) * static_cast<std::size_t>(channels_)),
        masses_(stride_ * static_cast<std::size_t>(height + 2 * kMargin)) {}

  /// Four values at a time: `mass` has room for that.
  static constexpr int padded(int channels) { return (channels + 3) / 4 * 4; }

  /// `mass` (one value per channel, padded with anything finite, times `weight`) at u, v of the grid's
  /// picture: spread over 6×6 points by the weights of Lagrange interpolation of degree five there.
  void add(float u, float v, const float* mass, float weight) {
    const float x = u * static_cast<float>(width_) - 0.5f, y = v * static_cast<float>(height_) - 0.5f;
    // x and y are above −2: truncating rounds down.
    const int left = static_cast<int>(x + 2) - 2, top = static_cast<int>(y + 2) - 2;
    float wx[6], wy[6];
    lagrange6(x - static_cast<float>(left), wx);
    lagrange6(y - static_cast<float>(top), wy);
    const int column = std::clamp(left, -1, width_ - 1) - 2 + kMargin;
    const int row = std::clamp(top, -1, height_ - 1) - 2 + kMargin;
    float* to = masses_.data() + static_cast<std::size_t>(row) * stride_ +
                static_cast<std::size_t>(column) * static_cast<std::size_t>(channels_);
    for (int first = 0; first < channels_; first += 4) {
      float part[4];
      for (int c = 0; c < 4; ++c) part[c] = weight * mass[first + c];
      for (int j = 0; j < 6; ++j) {
        float* at = to + static_cast<std::size_t>(j) * stride_ + first;
        for (int i = 0; i < 6; ++i, at += channels_) {
          const float w = wy[j] * wx[i];
          for (int c = 0; c < 4; ++c) at[c] += w * part[c];
        }
      }
    }
  }

  /// Brings what lies past the edges to where it belongs: left and right go around, and past a pole the rows
  /// go on down the opposite meridian.
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
    return masses_.data() + static_cast<std::size_t>(y + kMargin) * stride_ +
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
  std::vector<float> masses_;
};

/// The largest sides of a texel of a map of this size, radians, from a raster of places.
struct TexelSides {
  double across = 0, down = 0;
};
TexelSides largest_texel(const AnyParameterization& p, int width, int height) {
  constexpr int kRaster = 24;
  TexelSides largest;
  for (int chart = 0; chart < p.charts(); ++chart) {
    for (int j = 0; j < kRaster; ++j) {
      for (int i = 0; i < kRaster; ++i) {
        const double u = (i + 0.5) / kRaster, v = (j + 0.5) / kRaster;
        if (!p.valid(chart, u, v)) continue;
        const double step = 1e-4;
        const Vec3d d = p.to_sphere(chart, u, v);
        largest.across =
            std::max(largest.across, length(p.to_sphere(chart, u + step, v) - d) / (step * width));
        largest.down = std::max(largest.down, length(p.to_sphere(chart, u, v + step) - d) / (step * height));
      }
    }
  }
  return largest;
}

/// Where along a side of a texel, 0 … 1, its points lie: two of Gauss's in each cell, cells no wider than a
/// step of the grid. One point where the texel is far finer.
std::vector<float> offsets_of(double texel, double step) {
  if (texel < step / 6) return {0.5f};
  const int cells = std::max(1, static_cast<int>(std::ceil(texel / step - 1e-3)));
  std::vector<float> offsets;
  for (int cell = 0; cell < cells; ++cell) {
    for (double side : {-1.0, 1.0}) {
      offsets.push_back(static_cast<float>((cell + 0.5 + side / (2 * std::sqrt(3.0))) / cells));
    }
  }
  return offsets;
}

/// Deposits rows of any map.
class Scatter {
 public:
  Scatter(const Map& map, int height)
      : map_(map), full_(map.parameterization.full_charts()), grid_(AnyParameterization::make("latlong")) {
    const double step = kPi / height;
    const TexelSides texel = largest_texel(map.parameterization, map.width(), map.height());
    across_ = offsets_of(texel.across, step);
    down_ = offsets_of(texel.down, step);
  }

  void row(int chart, int y, Deposit& deposit) const {
    const int width = map_.width(), n = map_.channels();
    const float* texels = map_.level.chart(chart).row(y);
    alignas(64) float to_chart[kBatch], to_u[kBatch], to_v[kBatch];
    for (float down : down_) {
      for (float across : across_) {
        for (int from = 0; from < width; from += static_cast<int>(kBatch)) {
          Points points(*this, chart, y, from, across, down);
          grid_.kernels().from_sphere(grid_.self(), points.x, points.y, points.z, to_chart, to_u, to_v,
                                      points.count);
          for (std::size_t i = 0; i < points.count; ++i) {
            const std::size_t column = static_cast<std::size_t>(from) + i;
            if (points.weight[i] == 0) continue;
            // Texels past the row's end, if read, are its border: any values will do, and reading them is
            // allowed.
            deposit.add(to_u[i], to_v[i], texels + column * static_cast<std::size_t>(n), points.weight[i]);
          }
        }
      }
    }
  }

 private:
  static constexpr std::size_t kBatch = 256;

  /// One point of each of up to kBatch texels of a row: directions, and the solid angles that they stand for;
  /// 0 outside the map's places.
  struct Points {
    Points(const Scatter& s, int chart, int row, int from, float across, float down) {
      const AnyParameterization& p = s.map_.parameterization;
      const int width = s.map_.width(), height = s.map_.height();
      count = std::min(kBatch, static_cast<std::size_t>(width - from));
      alignas(64) float u[kBatch], v[kBatch], mask[kBatch];
      for (std::size_t i = 0; i < sphere::padded(count); ++i) {
        const float column = static_cast<float>(from + static_cast<int>(std::min(i, count - 1)));
        u[i] = (column + across) / static_cast<float>(width);
        v[i] = (static_cast<float>(row) + down) / static_cast<float>(height);
      }
      p.kernels().to_sphere(p.self(), chart, u, v, x, y, z, count);
      p.kernels().density(p.self(), chart, u, v, weight, count);
      const double points = static_cast<double>(s.across_.size()) * static_cast<double>(s.down_.size());
      const float area = static_cast<float>(1 / (points * width * height));
      for (std::size_t i = 0; i < count; ++i) weight[i] = std::max(weight[i], 0.0f) * area;
      if (s.full_) return;
      p.kernels().valid(p.self(), chart, u, v, mask, count);
      for (std::size_t i = 0; i < count; ++i) weight[i] = mask[i] > 0 ? weight[i] : 0.0f;
    }
    alignas(64) float x[kBatch], y[kBatch], z[kBatch], weight[kBatch];
    std::size_t count;
  };

  const Map& map_;
  bool full_;
  AnyParameterization grid_;
  std::vector<float> across_, down_;  ///< places of the points along the sides of a texel, 0 … 1
};

}  // namespace

void scatter_texels(const Map& map, Moments& moments, const Monitor& monitor) {
  const int width = moments.width, height = moments.height, n = moments.channels;
  const Scatter scatter(map, height);
  const int rows = map.charts() * map.height();
  // The number of deposits doesn't depend on the number of threads, so neither do the sums.
  const int slices = std::min(8, rows);
  std::vector<Deposit> deposits;
  for (int i = 0; i < slices; ++i) deposits.emplace_back(width, height, n);
  parallel_for(
      slices,
      [&](int slice) {
        const auto first = [&](int i) {
          return static_cast<int>(static_cast<std::int64_t>(rows) * i / slices);
        };
        for (int row = first(slice); row < first(slice + 1); ++row) {
          if (monitor.cancelled && monitor.cancelled()) throw Cancelled();
          scatter.row(row / map.height(), row % map.height(), deposits[static_cast<std::size_t>(slice)]);
        }
        deposits[static_cast<std::size_t>(slice)].fold();
      },
      monitor);
  parallel_for(moments.packs, [&](int pack) {
    for (int lane = 0; lane < 16; ++lane) {
      const int north = pack * 8 + lane % 8, y = lane < 8 ? north : height - 1 - north;
      for (int c = 0; c < n; ++c) {
        float* to = moments.at(pack, c) + lane;
        for (int x = 0; x < width; ++x) to[x * 16] = 0;
        if (north >= height / 2) continue;
        for (Deposit& deposit : deposits) {
          const float* from = deposit.row(y) + c;
          for (int x = 0; x < width; ++x) to[x * 16] += from[x * Deposit::padded(n)];
        }
      }
    }
  });
}

}  // namespace welkin::prefilter
