#include "welkin/filter/refinement.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace welkin {
namespace {

/// Values that kernels may read or write past the end of a row.
constexpr std::size_t kSlack = 64;

/// Texels of a chart.
struct Rectangle {
  int x, y, width, height;
};

/// A copy of the texels that reconstructing a rectangle takes. The last ones of the border stand for those
/// past it.
LevelView copy_texels(const LevelView& level, int chart, const Rectangle& r, std::vector<float>& copy) {
  constexpr int kReach = kReconstructionReach;
  const int columns = r.width + 2 * kReach, rows = r.height + 2 * kReach;
  const std::size_t channels = static_cast<std::size_t>(level.channels);
  const std::size_t stride = static_cast<std::size_t>(columns) * channels;
  copy.resize(stride * static_cast<std::size_t>(rows) + kSlack);
  float* to = copy.data();
  for (int j = 0; j < rows; ++j) {
    const int y = std::clamp(r.y - kReach + j, -kBorder, level.height + kBorder - 1);
    const float* row = level.texels + chart * level.chart_stride + y * level.row_stride;
    for (int i = 0; i < columns; ++i, to += channels) {
      const int x = std::clamp(r.x - kReach + i, -kBorder, level.width + kBorder - 1);
      std::copy_n(row + static_cast<std::ptrdiff_t>(x) * level.channels, channels, to);
    }
  }
  LevelView view = level;
  view.row_stride = static_cast<std::ptrdiff_t>(stride);
  view.chart_stride = 0;
  view.texels = copy.data() - (r.y - kReach) * view.row_stride -
                static_cast<std::ptrdiff_t>(r.x - kReach) * level.channels;
  return view;
}

/// Each part's share of its texel's solid angle.
class Shares {
 public:
  Shares(const LevelView& level, const PartsOfTexels& parts, const Rectangle& r, RefinementWork& work)
      : level_(level),
        parts_(parts),
        rectangle_(r),
        work_(work),
        stride_(static_cast<std::size_t>(r.width * level.channels) + kSlack) {
    work.shares.resize(stride_ * kMostParts * kMostParts);
    const std::size_t row = sphere::padded(static_cast<std::size_t>(r.width * parts.parts));
    for (std::vector<float>* each : {&work.u, &work.v}) each->resize(row);
    work.density.resize(row * kMostParts);
  }

  std::size_t stride() const { return stride_; }

  /// Of a row of texels: one row of values, for each channel alike, for each part.
  void fill(int chart, int row) {
    if (parts_.row_angle == nullptr) return fill_by_density(chart, row);
    const int n = parts_.parts;
    const auto angle = [&](int part) {
      return (*parts_.row_angle)[static_cast<std::size_t>(part_inside(row * n + part, level_.height * n))];
    };
    float sum = 0;
    for (int j = 0; j < n; ++j) sum += angle(j);
    for (int t = 0; t < n * n; ++t) {
      const float share = angle(t / n) / (sum * static_cast<float>(n));
      std::fill_n(work_.shares.data() + static_cast<std::size_t>(t) * stride_, stride_, share);
    }
  }

 private:
  void fill_by_density(int chart, int row) {
    const int n = parts_.parts, columns = rectangle_.width * n;
    const float across = 1.0f / static_cast<float>(level_.width * n),
                down = 1.0f / static_cast<float>(level_.height * n);
    const std::size_t padded = work_.u.size();
    const auto middle = [](int part, int size, float side) {
      return (static_cast<float>(part_inside(part, size)) + 0.5f) * side;
    };
    for (std::size_t i = 0; i < padded; ++i) {
      const int column = std::min(static_cast<int>(i), columns - 1);
      work_.u[i] = middle(rectangle_.x * n + column, level_.width * n, across);
    }
    for (int j = 0; j < n; ++j) {
      std::fill(work_.v.begin(), work_.v.end(), middle(row * n + j, level_.height * n, down));
      parts_.source.kernels().density(parts_.source.self(), chart, work_.u.data(), work_.v.data(),
                                      work_.density.data() + static_cast<std::size_t>(j) * padded,
                                      static_cast<std::size_t>(columns));
    }
    const std::size_t channels = static_cast<std::size_t>(level_.channels),
                      all = static_cast<std::size_t>(n * n);
    for (std::size_t x = 0; x < static_cast<std::size_t>(rectangle_.width); ++x) {
      std::array<float, kMostParts * kMostParts> share{};
      float sum = 0;
      for (std::size_t t = 0; t < all; ++t) {
        const std::size_t of_part = t / static_cast<std::size_t>(n) * padded +
                                    x * static_cast<std::size_t>(n) + t % static_cast<std::size_t>(n);
        share[t] = std::max(work_.density[of_part], 0.0f);
        sum += share[t];
      }
      const bool known = sum > 0 && std::isfinite(sum);
      for (std::size_t t = 0; t < all; ++t) {
        std::fill_n(work_.shares.data() + t * stride_ + x * channels, channels,
                    known ? share[t] / sum : 1.0f / static_cast<float>(all));
      }
    }
  }

  const LevelView& level_;
  const PartsOfTexels& parts_;
  const Rectangle rectangle_;
  RefinementWork& work_;
  const std::size_t stride_;
};

/// Row by row of texels, side by side of each row of parts.
void divide_texels(const LevelView& texels, const PartsOfTexels& parts, const Rectangle& r, int chart,
                   const ReconstructionKernels& kernels, RefinementWork& work, std::vector<float>& out) {
  const int n = parts.parts;
  const std::size_t count = static_cast<std::size_t>(n), channels = static_cast<std::size_t>(texels.channels);
  const std::size_t width = static_cast<std::size_t>(r.width), stride = width * count * channels;
  out.resize(stride * static_cast<std::size_t>(r.height * n));
  Shares shares(texels, parts, r, work);
  work.divided.resize(shares.stride() * count * count);
  for (int row = 0; row < r.height; ++row) {
    shares.fill(chart, r.y + row);
    kernels.divide(texels, work.whole, row, n, {work.shares.data(), work.divided.data(), shares.stride()});
    for (std::size_t t = 0; t < count * count; ++t) {
      const float* from = work.divided.data() + t * shares.stride();
      float* to =
          out.data() + (static_cast<std::size_t>(row) * count + t / count) * stride + t % count * channels;
      for (std::size_t x = 0; x < width; ++x, to += count * channels) {
        for (std::size_t c = 0; c < channels; ++c) to[c] = *from++;
      }
    }
  }
}

}  // namespace

int parts_for(double footprint) {
  if (footprint > 0.2) return 1;
  return footprint > 0.1 ? 2 : kMostParts;
}

Refinement::Refinement(const LevelView& level, const PartsOfTexels& parts, const Reconstruction& how,
                       const ReconstructionKernels& kernels)
    : level_(level),
      parts_(parts),
      how_(how),
      kernels_(kernels),
      columns_((level.width + 2 + kTile - 1) / kTile),
      rows_((level.height + 2 + kTile - 1) / kTile),
      tiles_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) *
             static_cast<std::size_t>(level.charts)) {
  how_.limited = false;
}

const Refinement::Texels& Refinement::tile(int chart, int column, int row, RefinementWork& work) const {
  Tile& tile = tiles_[(static_cast<std::size_t>(chart) * static_cast<std::size_t>(rows_) +
                       static_cast<std::size_t>(row)) *
                          static_cast<std::size_t>(columns_) +
                      static_cast<std::size_t>(column)];
  std::call_once(tile.made, [&] {
    const int x = column * kTile - 1, y = row * kTile - 1;
    const Rectangle r{x, y, std::min(kTile, level_.width + 1 - x), std::min(kTile, level_.height + 1 - y)};
    const LevelView copy = copy_texels(level_, chart, r, work.texels);
    work.whole.reset(chart, r.x, r.y, r.width, r.height, level_.channels);
    kernels_.reconstruct(copy, how_, work.whole);
    auto texels = std::make_unique<Texels>();
    texels->width = r.width;
    texels->hard = work.whole.hard;
    divide_texels(copy, parts_, r, chart, kernels_, work, texels->parts);
    tile.texels = std::move(texels);
  });
  return *tile.texels;
}

void Refinement::reconstruct(RefinementWork& work, ReconstructedTexels& out) const {
  const int n = parts_.parts, side = kTile * n;
  const std::size_t channels = static_cast<std::size_t>(out.channels);
  // One more part on each side. Positions below are from texel −1 on.
  const int left = out.x - 1 + n, top = out.y - 1 + n, width = out.width + 2, height = out.height + 2;
  const std::size_t stride = static_cast<std::size_t>(width) * channels;
  work.parts.resize(stride * static_cast<std::size_t>(height) + kSlack);
  for (int row = top / side; row * side < top + height; ++row) {
    const int first_y = std::max(top, row * side), last_y = std::min(top + height, (row + 1) * side);
    for (int column = left / side; column * side < left + width; ++column) {
      const int first_x = std::max(left, column * side), last_x = std::min(left + width, (column + 1) * side);
      const Texels& texels = tile(out.chart, column, row, work);
      for (int y = first_y; y < last_y; ++y) {
        const int in_tile = (y - row * side) * texels.width * n + first_x - column * side;
        std::copy_n(texels.parts.data() + static_cast<std::size_t>(in_tile) * channels,
                    static_cast<std::size_t>(last_x - first_x) * channels,
                    work.parts.data() + static_cast<std::size_t>(y - top) * stride +
                        static_cast<std::size_t>(first_x - left) * channels);
        if (y == top || y == top + height - 1) continue;
        std::uint8_t* hard = out.hard.data() + static_cast<std::ptrdiff_t>(y - top - 1) * out.width;
        const std::uint8_t* of_row = texels.hard.data() + (y - row * side) / n * texels.width;
        for (int x = std::max(first_x, left + 1); x < std::min(last_x, left + width - 1); ++x)
          hard[x - left - 1] = of_row[(x - column * side) / n];
      }
    }
  }
  LevelView view = level_;
  view.row_stride = static_cast<std::ptrdiff_t>(stride);
  view.texels = work.parts.data() - (out.y - 1) * view.row_stride -
                static_cast<std::ptrdiff_t>(out.x - 1) * level_.channels;
  kernels_.reconstruct_parts(view, out);
}

}  // namespace welkin
