#include "welkin/prefilter/scatter.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace welkin::prefilter {
namespace {

using sphere::AnyParameterization;

/// Masses deposited at any place: a grid with two rows and columns more on every side, folded in at the end.
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
  /// picture: spread over 4×4 points by the weights of cubic Lagrange interpolation there.
  void add(float u, float v, const float* mass, float weight) {
    const float x = u * static_cast<float>(width_) - 0.5f, y = v * static_cast<float>(height_) - 0.5f;
    // x and y are above −2: truncating rounds down.
    const int left = static_cast<int>(x + 2) - 2, top = static_cast<int>(y + 2) - 2;
    float wx[4], wy[4];
    weights(x - static_cast<float>(left), wx);
    weights(y - static_cast<float>(top), wy);
    const int column = std::clamp(left, -1, width_ - 1) - 1 + kMargin;
    const int row = std::clamp(top, -1, height_ - 1) - 1 + kMargin;
    float* to = masses_.data() + static_cast<std::size_t>(row) * stride_ +
                static_cast<std::size_t>(column) * static_cast<std::size_t>(channels_);
    for (int first = 0; first < channels_; first += 4) {
      float part[4];
      for (int c = 0; c < 4; ++c) part[c] = weight * mass[first + c];
      for (int j = 0; j < 4; ++j) {
        float* at = to + static_cast<std::size_t>(j) * stride_ + first;
        for (int i = 0; i < 4; ++i, at += channels_) {
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
  static constexpr int kMargin = 2;

  static void weights(float f, float* w) {
    const float a = f + 1, b = f - 1, c = f - 2;
    w[0] = -f * b * c * (1.0f / 6);
    w[1] = a * b * c * 0.5f;
    w[2] = -a * f * c * 0.5f;
    w[3] = a * f * b * (1.0f / 6);
  }

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

/// The largest side of a texel of a map of this size, radians, from a raster of places.
double largest_texel(const AnyParameterization& p, int width, int height) {
  constexpr int kRaster = 24;
  double largest = 0;
  for (int chart = 0; chart < p.charts(); ++chart) {
    for (int j = 0; j < kRaster; ++j) {
      for (int i = 0; i < kRaster; ++i) {
        const double u = (i + 0.5) / kRaster, v = (j + 0.5) / kRaster;
        if (!p.valid(chart, u, v)) continue;
        const double step = 1e-4;
        const Vec3d d = p.to_sphere(chart, u, v);
        largest = std::max(largest, length(p.to_sphere(chart, u + step, v) - d) / (step * width));
        largest = std::max(largest, length(p.to_sphere(chart, u, v + step) - d) / (step * height));
      }
    }
  }
  return largest;
}

/// Deposits rows of any map: each texel by points of Gauss's rule in its sub-cells.
class Scatter {
 public:
  Scatter(const Map& map, int width, int height) : map_(map), grid_(AnyParameterization::make("latlong")) {
    const double step = kPi / height, texel = largest_texel(map.parameterization, map.width(), map.height());
    (void)width;
    if (texel < step / 6) {
      offsets_ = {0.5f};
    } else {
      // Two points each in cells no wider than a step of the grid.
      const int cells = std::max(1, static_cast<int>(std::ceil(texel / step - 1e-3)));
      for (int cell = 0; cell < cells; ++cell) {
        for (double side : {-1.0, 1.0}) {
          offsets_.push_back(static_cast<float>((cell + 0.5 + side / (2 * std::sqrt(3.0))) / cells));
        }
      }
    }
  }

  void row(int chart, int y, Deposit& deposit) const {
    constexpr std::size_t kBatch = 256;
    alignas(64) float u[kBatch], v[kBatch], dx[kBatch], dy[kBatch], dz[kBatch], density[kBatch], mask[kBatch];
    alignas(64) float to_chart[kBatch], to_u[kBatch], to_v[kBatch];
    const AnyParameterization& p = map_.parameterization;
    const bool full = p.full_charts();
    const int width = map_.width(), height = map_.height(), n = map_.channels();
    const float* texels = map_.level.chart(chart).row(y);
    const double points = static_cast<double>(offsets_.size());
    const float area = static_cast<float>(1.0 / (points * points * width * height));
    for (float down : offsets_) {
      for (float across : offsets_) {
        for (int from = 0; from < width; from += static_cast<int>(kBatch)) {
          const std::size_t count = std::min(kBatch, static_cast<std::size_t>(width - from));
          for (std::size_t i = 0; i < sphere::padded(count); ++i) {
            const float x = static_cast<float>(from + static_cast<int>(std::min(i, count - 1)));
            u[i] = (x + across) / static_cast<float>(width);
            v[i] = (static_cast<float>(y) + down) / static_cast<float>(height);
          }
          p.kernels().to_sphere(p.self(), chart, u, v, dx, dy, dz, count);
          p.kernels().density(p.self(), chart, u, v, density, count);
          if (!full) p.kernels().valid(p.self(), chart, u, v, mask, count);
          grid_.kernels().from_sphere(grid_.self(), dx, dy, dz, to_chart, to_u, to_v, count);
          for (std::size_t i = 0; i < count; ++i) {
            if (!full && mask[i] == 0) continue;
            // Texels past the row's end, if read, are its border: any values will do, and reading them is
            // allowed.
            const float* texel = texels + (static_cast<std::size_t>(from) + i) * static_cast<std::size_t>(n);
            deposit.add(to_u[i], to_v[i], texel, std::max(density[i], 0.0f) * area);
          }
        }
      }
    }
  }

 private:
  const Map& map_;
  AnyParameterization grid_;
  std::vector<float> offsets_;  ///< of the points in a texel, 0 … 1, the same along both sides
};

}  // namespace

void scatter_texels(const Map& map, Moments& moments, const Monitor& monitor) {
  const int width = moments.width, height = moments.height, n = moments.channels;
  const Scatter scatter(map, width, height);
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
