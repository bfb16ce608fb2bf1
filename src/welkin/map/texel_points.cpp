#include "welkin/map/texel_points.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "welkin/base/error.h"
#include "welkin/math/gauss_legendre.h"

namespace welkin {
namespace {

using sphere::AnyParameterization;

/// When subdividing a cell changes its density by more than this, there is a kink or the cell is large.
constexpr float kPlain = 1e-5f;

/// How often a cell with a kink is subdivided at most, and a large one.
constexpr int kKinkDepth = 7, kLargeDepth = 12;

/// Subdivides a cell.
class CellPoints {
 public:
  CellPoints(const AnyParameterization& p, const CellLimits& limits, std::vector<TexelPoint>& points)
      : p_(p), full_(p.full_charts()), limits_(limits), points_(points) {}

  void add(const ChartCell& cell, int depth) {
    if (!full_) {
      const Corners corners(p_, cell);
      const int valid = corners.count() + valid_points(cell);
      if (valid == 0 && depth >= std::min(1, limits_.rim_depth)) return;
      if (valid < 8) {
        if (depth < limits_.rim_depth || is_large(cell, depth, 0.25)) return add_quarters(cell, depth);
        return corners.differ_along_u() ? add_strips<true>(cell) : add_strips<false>(cell);
      }
    }
    if (is_large(cell, depth, 1)) return add_quarters(cell, depth);
    if (depth < kKinkDepth) {
      double finer = 0;
      for (int k = 0; k < 4; ++k) finer += solid_angle(cell.part(k % 2, 2, k / 2, 2));
      if (std::fabs(finer - solid_angle(cell)) > limits_.solid_angle) return add_quarters(cell, depth);
    }
    if (limits_.side > 4) return append_gauss_points(p_, cell, points_);
    // A small solid angle can be long, as at the rim of a mirror ball.
    const Sides sides = sides_of(cell);
    const double longer = std::max(sides.along_u, sides.along_v);
    if (longer > 12 * limits_.side && depth < kLargeDepth) return add_quarters(cell, depth);
    if (longer <= limits_.side) return append_gauss_points(p_, cell, points_);
    return sides.along_u > sides.along_v ? add_strips<true>(cell) : add_strips<false>(cell);
  }

 private:
  /// Whether the corners of a cell are valid.
  struct Corners {
    Corners(const AnyParameterization& p, const ChartCell& cell) {
      for (int k = 0; k < 4; ++k) {
        valid[static_cast<std::size_t>(k)] =
            p.valid(cell.chart, cell.u + k % 2 * cell.width, cell.v + k / 2 * cell.height) ? 1 : 0;
      }
    }
    int count() const { return valid[0] + valid[1] + valid[2] + valid[3]; }
    /// The rim is crossed by going along u rather than along v.
    bool differ_along_u() const {
      const int along_u = std::abs(valid[0] - valid[1]) + std::abs(valid[2] - valid[3]);
      const int along_v = std::abs(valid[0] - valid[2]) + std::abs(valid[1] - valid[3]);
      return along_u >= along_v;
    }
    std::array<int, 4> valid;
  };

  int valid_points(const ChartCell& cell) const {
    int count = 0;
    for (int k = 0; k < 4; ++k) {
      const double u = cell.u + kGauss[k % 2] * cell.width, v = cell.v + kGauss[k / 2] * cell.height;
      count += p_.valid(cell.chart, u, v) ? 1 : 0;
    }
    return count;
  }

  /// By 2×2 points, those that are valid.
  double solid_angle(const ChartCell& cell) const {
    double sum = 0;
    for (int k = 0; k < 4; ++k) {
      const double u = cell.u + kGauss[k % 2] * cell.width, v = cell.v + kGauss[k / 2] * cell.height;
      if (full_ || p_.valid(cell.chart, u, v)) sum += p_.solid_angle_density(cell.chart, u, v);
    }
    return sum * cell.width * cell.height / 4;
  }

  /// Beside `part` of the square of the side.
  bool is_large(const ChartCell& cell, int depth, double part) const {
    return depth < kLargeDepth && solid_angle(cell) > part * limits_.side * limits_.side;
  }

  /// Twice the longer half of each.
  struct Sides {
    double along_u, along_v;
  };
  Sides sides_of(const ChartCell& cell) const {
    const auto at = [&](double across, double down) {
      return p_.to_sphere(cell.chart, cell.u + across * cell.width, cell.v + down * cell.height);
    };
    const Vec3d middle = at(0.5, 0.5);
    return {2 * std::max(length(at(0, 0.5) - middle), length(at(1, 0.5) - middle)),
            2 * std::max(length(at(0.5, 0) - middle), length(at(0.5, 1) - middle))};
  }

  void add_quarters(const ChartCell& cell, int depth) {
    for (int k = 0; k < 4; ++k) add(cell.part(k % 2, 2, k / 2, 2), depth + 1);
  }

  /// Four strips along u, or along v, each from rim to rim or to the cell's ends.
  template <bool kAlongU>
  void add_strips(const ChartCell& cell) {
    static const QuadratureRule rule = gauss_legendre(4);
    for (std::size_t strip = 0; strip < rule.nodes.size(); ++strip) {
      const double across = 0.5 + 0.5 * rule.nodes[strip];
      const auto u = [&](double along) { return cell.u + (kAlongU ? along : across) * cell.width; };
      const auto v = [&](double along) { return cell.v + (kAlongU ? across : along) * cell.height; };
      const auto valid = [&](double along) { return p_.valid(cell.chart, u(along), v(along)); };
      const auto rim = [&](double inside, double outside) {
        for (int i = 0; i < 16; ++i) {
          const double middle = (inside + outside) / 2;
          (valid(middle) ? inside : outside) = middle;
        }
        return inside;
      };
      double inside = -1;
      for (const double along : {0.0, 1.0, 0.5, 0.25, 0.75}) {
        if (inside < 0 && valid(along)) inside = along;
      }
      if (inside < 0) continue;
      const double from = valid(0) ? 0 : rim(inside, 0), to = valid(1) ? 1 : rim(inside, 1);
      const auto direction = [&](double along) { return p_.to_sphere(cell.chart, u(along), v(along)); };
      const double middle = (from + to) / 2;
      // From the middle to either end. The density may be infinite on the rim, as 1/√distance: with the
      // distance a square it is smooth.
      for (const double end : {from, to}) {
        const double share = (middle - from) * cell.width * cell.height * rule.weights[strip] / 2;
        const int panels = 1 + static_cast<int>(length(direction(end) - direction(middle)) / limits_.side);
        for (int k = 0; k < 4 * panels; ++k) {
          const std::size_t i = static_cast<std::size_t>(k % 4);
          const double root = (k / 4 + 0.5 + 0.5 * rule.nodes[i]) / panels;
          const double along = end + (middle - end) * root * root;
          const double density = p_.solid_angle_density(cell.chart, u(along), v(along));
          points_.push_back({direction(along), density * share * rule.weights[i] * root / panels});
        }
      }
    }
  }

  const AnyParameterization& p_;
  bool full_;
  CellLimits limits_;
  std::vector<TexelPoint>& points_;
};

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

ChartCell ChartCell::part(int x, int columns, int y, int rows) const {
  return {chart, u + width * x / columns, v + height * y / rows, width / columns, height / rows};
}

ChartCell texel_cell(ChartSize size, int chart, int x, int y) {
  return {chart, static_cast<double>(x) / size.width, static_cast<double>(y) / size.height, 1.0 / size.width,
          1.0 / size.height};
}

void append_gauss_points(const AnyParameterization& p, const ChartCell& cell,
                         std::vector<TexelPoint>& points) {
  const double area = cell.width * cell.height / 4;
  for (int k = 0; k < 4; ++k) {
    const double u = cell.u + kGauss[k % 2] * cell.width, v = cell.v + kGauss[k / 2] * cell.height;
    points.push_back({p.to_sphere(cell.chart, u, v), p.solid_angle_density(cell.chart, u, v) * area});
  }
}

void append_points(const AnyParameterization& p, const ChartCell& cell, const CellLimits& limits,
                   std::vector<TexelPoint>& points) {
  CellPoints(p, limits, points).add(cell, 0);
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
