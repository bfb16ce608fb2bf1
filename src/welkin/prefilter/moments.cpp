#include "welkin/prefilter/moments.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

#include "welkin/prefilter/fft.h"
#include "welkin/prefilter/kernels.h"

namespace welkin::prefilter {
namespace {

using sphere::AnyParameterization;

/// Masses deposited at any place: a grid with two rows and columns more on every side, folded in at the end.
class Deposit {
 public:
  Deposit(int width, int height, int channels)
      : width_(width),
        height_(height),
        channels_(channels),
        stride_(static_cast<std::size_t>(width + 2 * kMargin) * static_cast<std::size_t>(channels)),
        masses_(stride_ * static_cast<std::size_t>(height + 2 * kMargin)) {}

  /// `mass` (one value per channel, times `weight`) at u, v of the grid's picture: spread over 4×4 points by
  /// the weights of cubic Lagrange interpolation there.
  void add(float u, float v, const float* mass, float weight) {
    const float x = u * static_cast<float>(width_) - 0.5f, y = v * static_cast<float>(height_) - 0.5f;
    const float left = std::floor(x), top = std::floor(y);
    float wx[4], wy[4];
    weights(x - left, wx);
    weights(y - top, wy);
    const int column = std::clamp(static_cast<int>(left), -1, width_ - 1) - 1 + kMargin;
    const int row = std::clamp(static_cast<int>(top), -1, height_ - 1) - 1 + kMargin;
    float* to = masses_.data() + static_cast<std::size_t>(row) * stride_ +
                static_cast<std::size_t>(column) * static_cast<std::size_t>(channels_);
    for (int j = 0; j < 4; ++j, to += stride_) {
      for (int i = 0; i < 4; ++i) {
        const float w = weight * wy[j] * wx[i];
        for (int c = 0; c < channels_; ++c) to[i * channels_ + c] += w * mass[c];
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

void scatter(const Map& map, Moments& moments, const Monitor& monitor) {
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
          for (int x = 0; x < width; ++x) to[x * 16] += from[x * n];
        }
      }
    }
  });
}

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

/// Weights of Lagrange's polynomials through the nodes −2 … 3 at x, 0 ≤ x ≤ 1.
void lagrange6(double x, double* w) {
  for (int k = 0; k < 6; ++k) {
    w[k] = 1;
    for (int other = 0; other < 6; ++other) {
      if (other != k) w[k] *= (x - (other - 2)) / (k - other);
    }
  }
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
  // Gauss's rule of four points.
  constexpr double kPlaces[4] = {-0.861136311594053, -0.339981043584856, 0.339981043584856,
                                 0.861136311594053};
  constexpr double kWeights[4] = {0.347854845137454, 0.652145154862546, 0.652145154862546, 0.347854845137454};
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
      for (int k = 0; k < 4; ++k) {
        const double y = (from + to) / 2 + kPlaces[k] * (to - from) / 2;
        double w[6];
        lagrange6(y - node, w);
        const double measure = std::sin(y * step) * step * (to - from) / 2 * kWeights[k] * 2 * kPi / columns;
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
  reach = (3 * columns + 1) / 2;
  for (int i = -reach; i < columns + reach; ++i) {
    const double middle = (i + 0.5) / columns - 0.5, half = 0.5 / columns;
    // A texel in the middle of an even number of columns can straddle a kink of the kernel: each half by
    // itself.
    double sum = 0;
    for (double side : {-0.5, 0.5}) {
      for (const auto& [place, weight] : {std::pair(-0.774596669241483, 5.0 / 18), std::pair(0.0, 8.0 / 18),
                                          std::pair(0.774596669241483, 5.0 / 18)}) {
        sum += weight / 2 * kernel(middle + side * half + place * half / 2);
      }
    }
    along.push_back(static_cast<float>(sum));
  }
}

MomentPlan::MomentPlan(const AnyParameterization& source, ChartSize size, int degree) {
  const int least = std::max(16, static_cast<int>(1.42 * degree));
  const bool latlong = source.spec() == "latlong" && size.width % 2 == 0 && fft_takes(size.width);
  if (!latlong) {
    width = fft_length(std::max(2 * least, 64));
    height = width / 2;
    return;
  }
  // The picture's own rows and columns, or an even part of them, where they are enough.
  height = size.height;
  while (height % 2 == 0 && height / 2 >= least) height /= 2;
  if (height % 2 != 0 || height < least) height = (std::max(least, 16) + 1) / 2 * 2;
  int columns = 1;
  while (size.width % (4 * columns) == 0 && size.width / (2 * columns) >= 2 * least) columns *= 2;
  width = size.width / columns;
  // Three points stand for a box within 1e-3 up to an order where they are 2.3/2 radians apart.
  way = degree <= 2.3 * width / (2 * kPi) ? Way::spread_points : Way::spread_boxes;
  rows_per_mass = size.height % height == 0 ? size.height / height : 0;
  rows.emplace_back(size.width, size.height, height);
  this->columns.emplace_back(columns);
  if (way == Way::spread_boxes) {
    this->columns[0].reach = 0;
    this->columns[0].along = {1.0f};
    this->columns[0].columns = columns;
  }
}

Moments moments_of(const Map& map, const MomentPlan& plan, const Monitor& monitor) {
  Moments moments(plan.width, plan.height, map.channels());
  moments.boxes = plan.way == MomentPlan::Way::spread_boxes;
  if (plan.reduced) {
    moments.reduced.emplace(map.parameterization, plan.width, plan.height, map.channels());
    moments.reduced->orientation = map.orientation;
  }
  if (plan.way == MomentPlan::Way::scatter) {
    scatter(map, moments, monitor);
  } else {
    spread(map, plan, moments, monitor);
  }
  return moments;
}

}  // namespace welkin::prefilter
