#include "welkin/map/texel_points.h"

#include <algorithm>
#include <cmath>

#include "welkin/base/error.h"

namespace welkin {
namespace {

using sphere::AnyParameterization;

/// When subdividing a cell changes its density by more than this, there is a kink or the cell is large.
constexpr float kPlain = 1e-5f;

/// Gauss's rule of 2×2 points suffices where it differs from the value at the centre by less than this share:
/// along a kink of the density its error is as large as that.
constexpr float kSmooth = 1e-4f;

constexpr std::size_t kBatch = 256;

/// Values of a kernel at one position in each of up to kBatch texels of a row.
struct Batch {
  Batch(ChartSize size, int row, int from, double across, double down)
      : count(std::min(kBatch, static_cast<std::size_t>(size.width - from))) {
    for (std::size_t i = 0; i < sphere::padded(count); ++i) {
      const int column = from + static_cast<int>(std::min(i, count - 1));
      u[i] = static_cast<float>((column + across) / size.width);
      v[i] = static_cast<float>((row + down) / size.height);
    }
  }
  std::size_t count;
  alignas(64) float u[kBatch], v[kBatch], value[kBatch];
};

/// Adds share · density at the batch's positions to `sums`, and 1 to `valid` where one is valid; either may
/// be null. Returns how many texels the batch has.
std::size_t test_row(const AnyParameterization& p, Batch batch, int chart, float* sums, float share,
                     float* valid) {
  if (sums != nullptr) {
    p.kernels().density(p.self(), chart, batch.u, batch.v, batch.value, batch.count);
    for (std::size_t i = 0; i < batch.count; ++i) sums[i] += share * batch.value[i];
  }
  if (valid != nullptr) {
    p.kernels().valid(p.self(), chart, batch.u, batch.v, batch.value, batch.count);
    for (std::size_t i = 0; i < batch.count; ++i) valid[i] += batch.value[i] > 0 ? 1.0f : 0.0f;
  }
  return batch.count;
}

}  // namespace

ChartCell texel_cell(ChartSize size, int chart, int x, int y) {
  return {chart, static_cast<double>(x) / size.width, static_cast<double>(y) / size.height, 1.0 / size.width,
          1.0 / size.height};
}

double mean_texel(const AnyParameterization& p, ChartSize size) {
  return std::sqrt(p.coverage() / (static_cast<double>(p.charts()) * size.width * size.height));
}

CellLimits texel_limits(const AnyParameterization& p, ChartSize size) {
  const double texel = mean_texel(p, size);
  return {1e-6 * texel * texel};
}

bool is_outside_texel(const AnyParameterization& p, ChartSize size, int chart, int x, int y) {
  alignas(64) float u[32], v[32], valid[32];
  std::size_t count = 0;
  const auto at = [&](double across, double down) {
    u[count] = static_cast<float>((x + across) / size.width);
    v[count++] = static_cast<float>((y + down) / size.height);
  };
  at(0.5, 0.5);
  // What only touches a rim, as the texels beside a straight one do, is outside.
  constexpr double kAside = 1e-3;
  for (int k = 0; k < 4; ++k) {
    at(k % 2 == 0 ? kAside : 1 - kAside, k / 2 == 0 ? kAside : 1 - kAside);
    at(kGauss[k % 2], kGauss[k / 2]);
    for (int j = 0; j < 4; ++j) at((k % 2 + kGauss[j % 2]) / 2, (k / 2 + kGauss[j / 2]) / 2);
  }
  std::fill(u + count, std::end(u), u[0]);
  std::fill(v + count, std::end(v), v[0]);
  p.kernels().valid(p.self(), chart, u, v, valid, count);
  return std::none_of(valid, valid + count, [](float each) { return each > 0; });
}

void add_rim_texels(const AnyParameterization& p, ChartSize size, int chart, int x, int y, int count,
                    float* mask) {
  for (int i = 0; i < count; ++i) {
    if (!(mask[i] > 0) && !is_outside_texel(p, size, chart, x + i, y)) mask[i] = 1;
  }
}

std::vector<TexelKind> texel_kinds(const AnyParameterization& p, ChartSize size, int chart, int row) {
  const std::size_t width = static_cast<std::size_t>(size.width);
  const bool full = p.full_charts(), by_row = full && p.density_by_row();
  std::vector<TexelKind> kinds(width, TexelKind::plain);
  const std::size_t tested = by_row ? 1 : width;
  for (std::size_t from = 0; from < tested; from += kBatch) {
    float coarse[kBatch] = {}, fine[kBatch] = {}, valid[kBatch] = {};
    float points = 0;
    std::size_t count = 0;
    const auto test = [&](double across, double down, float* sums, float share) {
      count = test_row(p, Batch(size, row, static_cast<int>(from), across, down), chart, sums, share,
                       full ? nullptr : valid);
      if (!full) points += 1;
    };
    for (int k = 0; k < 4; ++k) {
      if (!full) test(k % 2, k / 2, nullptr, 0);
      test(kGauss[k % 2], kGauss[k / 2], coarse, 0.25f);
      for (int j = 0; j < 4; ++j) {
        test((k % 2 + kGauss[j % 2]) / 2, (k / 2 + kGauss[j / 2]) / 2, fine, 0.0625f);
      }
    }
    for (std::size_t i = 0; i < count && from + i < tested; ++i) {
      TexelKind& kind = kinds[from + i];
      // NaN is not plain.
      if (!(std::fabs(fine[i] - coarse[i]) <= kPlain * coarse[i])) kind = TexelKind::irregular;
      if (valid[i] < points) kind = valid[i] == 0 ? TexelKind::outside : TexelKind::irregular;
    }
  }
  if (by_row) std::fill(kinds.begin(), kinds.end(), kinds[0]);
  return kinds;
}

std::vector<double> summed_solid_angles(const AnyParameterization& p, ChartSize size, int chart, int row) {
  const std::vector<TexelKind> kinds = texel_kinds(p, size, chart, row);
  const bool by_row = p.full_charts() && p.density_by_row();
  std::vector<double> omega(static_cast<std::size_t>(size.width));
  std::vector<TexelPoint> points;
  for (int x = 0; x < size.width; ++x) {
    const std::size_t i = static_cast<std::size_t>(x);
    if (by_row && x > 0) {
      omega[i] = omega[0];
      continue;
    }
    points.clear();
    const ChartCell texel = texel_cell(size, chart, x, row);
    if (kinds[i] == TexelKind::plain) append_gauss_points(p, texel, points);
    if (kinds[i] == TexelKind::irregular) append_points(p, texel, texel_limits(p, size), points);
    for (const TexelPoint& point : points) omega[i] += point.solid_angle;
  }
  return omega;
}

void texel_solid_angles(const AnyParameterization& p, int width, int height, int chart, int row, float* out) {
  require(width > 0 && height > 0 && row >= 0 && row < height && chart >= 0 && chart < p.charts(),
          "there is no such row of texels");
  const ChartSize size{width, height};
  const bool full = p.full_charts();
  std::vector<TexelPoint> points;
  const auto summed = [&](int x) {
    points.clear();
    append_points(p, texel_cell(size, chart, x, row), texel_limits(p, size), points);
    double sum = 0;
    for (const TexelPoint& point : points) sum += point.solid_angle;
    return static_cast<float>(sum);
  };
  if (full && p.density_by_row()) {
    std::fill_n(out, width, summed(0));
    return;
  }
  const float area = 1.0f / (static_cast<float>(width) * static_cast<float>(height));
  for (int from = 0; from < width; from += static_cast<int>(kBatch)) {
    float centre[kBatch] = {}, mean[kBatch] = {}, valid[kBatch] = {};
    std::size_t count = 0;
    float tests = 0;
    const auto test = [&](double across, double down, float* sums, float share) {
      count = test_row(p, Batch(size, row, from, across, down), chart, sums, share, full ? nullptr : valid);
      if (!full) tests += 1;
    };
    test(0.5, 0.5, centre, 1);
    for (int k = 0; k < 4; ++k) {
      if (!full) test(k % 2, k / 2, nullptr, 0);
      test(kGauss[k % 2], kGauss[k / 2], mean, 0.25f);
    }
    for (std::size_t i = 0; i < count; ++i) {
      const int x = from + static_cast<int>(i);
      const bool outside = !full && valid[i] == 0, cut = !full && valid[i] < tests;
      // NaN is not smooth.
      const bool smooth = std::fabs(mean[i] - centre[i]) <= kSmooth * mean[i];
      out[x] = outside ? 0.0f : !cut && smooth ? mean[i] * area : summed(x);
    }
  }
}

void centred_solid_angles(const AnyParameterization& p, ChartSize size, int chart, int row, float* out) {
  texel_solid_angles(p, size.width, size.height, chart, row, out);
  if (p.full_charts()) return;
  for (int from = 0; from < size.width; from += static_cast<int>(kBatch)) {
    float valid[kBatch] = {};
    const std::size_t count = test_row(p, Batch(size, row, from, 0.5, 0.5), chart, nullptr, 0, valid);
    for (std::size_t i = 0; i < count; ++i) {
      if (valid[i] == 0) out[from + static_cast<int>(i)] = 0;
    }
  }
}

}  // namespace welkin
