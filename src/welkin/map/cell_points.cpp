#include "welkin/map/cell_points.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "welkin/math/gauss_legendre.h"

namespace welkin {
namespace {

using sphere::AnyParameterization;

/// How often a cell with a kink is subdivided at most, and a large one.
constexpr int kKinkDepth = 7, kLargeDepth = 12;

/// Cells at a rim over which the density varies too much for strips, sr, and how often they are subdivided.
constexpr double kWide = 0.03;
constexpr int kWideDepth = 3;

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
        const bool wide = depth < kWideDepth && solid_angle(cell) > kWide;
        if (depth < limits_.rim_depth || wide || is_large(cell, depth, 0.25))
          return add_quarters(cell, depth);
        return is_crossed_along_u(cell, corners) ? add_strips<true>(cell) : add_strips<false>(cell);
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
    std::array<int, 4> valid;
  };

  /// Whether a rim that crosses the cell is crossed by going along u rather than along v.
  bool is_crossed_along_u(const ChartCell& cell, const Corners& corners) const {
    const auto& valid = corners.valid;
    const auto at = [&](double across, double down) {
      return p_.valid(cell.chart, cell.u + across * cell.width, cell.v + down * cell.height) ? 1 : 0;
    };
    // What is valid lies at one of the sides.
    if (corners.count() == 0) return at(0.5, 0) + at(0.5, 1) == 0;
    const int along_u = std::abs(valid[0] - valid[1]) + std::abs(valid[2] - valid[3]);
    const int along_v = std::abs(valid[0] - valid[2]) + std::abs(valid[1] - valid[3]);
    if (along_u != along_v) return along_u > along_v;
    // One corner unlike the others: the rim is steeper than the cell where it is nearer along u.
    for (const std::size_t k : {0u, 1u, 2u, 3u}) {
      if (valid[k] == valid[k ^ 1] || valid[k] == valid[k ^ 2]) continue;
      const double across = k % 2 == 0 ? 0 : 1, down = k / 2 == 0 ? 0 : 1;
      return at(0.5, down) != valid[k] || at(across, 0.5) == valid[k];
    }
    return true;
  }

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

  /// Where validity changes between `inside` and `outside`, on the valid side.
  template <class Valid>
  static double change(const Valid& valid, double inside, double outside) {
    for (int i = 0; i < 40; ++i) {
      const double middle = (inside + outside) / 2;
      (valid(middle) ? inside : outside) = middle;
    }
    return inside;
  }

  /// Strips along u, or along v, each from rim to rim or to the cell's ends.
  template <bool kAlongU>
  void add_strips(const ChartCell& cell) {
    static const QuadratureRule rule = gauss_legendre(4);
    const auto valid = [&](double across, double along) {
      return p_.valid(cell.chart, cell.u + (kAlongU ? along : across) * cell.width,
                      cell.v + (kAlongU ? across : along) * cell.height);
    };
    // How long strips are has a kink where the rim meets an end of the cell, and may grow as a root from
    // there; so it may from a side of the cell where there is nothing, or a point.
    const auto thin = [&](double across) {
      int found = 0;
      for (int k = 0; k <= 4; ++k) found += valid(across, k / 4.0) ? 1 : 0;
      return found < 2;
    };
    double kinks[2 + 8] = {0};
    std::size_t count = 1;
    for (const double end : {0.0, 1.0}) {
      const auto at_end = [&](double across) { return valid(across, end); };
      for (int k = 0; k < 4; ++k) {
        const double from = k / 4.0, to = (k + 1) / 4.0;
        if (at_end(from) != at_end(to))
          kinks[count++] = at_end(from) ? change(at_end, from, to) : change(at_end, to, from);
      }
    }
    std::sort(kinks + 1, kinks + count);
    kinks[count] = 1;
    for (std::size_t k = 0; k < count; ++k) {
      const double from = kinks[k], to = kinks[k + 1], middle = (from + to) / 2;
      const bool at_from = k > 0 || thin(0), at_to = k + 1 < count || thin(1);
      if (!at_from && !at_to) {
        for (std::size_t i = 0; i < rule.nodes.size(); ++i)
          add_strip<kAlongU>(cell, 0.5 + 0.5 * rule.nodes[i], 0.5 * rule.weights[i]);
        continue;
      }
      // The distance from a kink as a square.
      const auto add_from = [&](double kink, double end) {
        for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
          const double root = 0.5 + 0.5 * rule.nodes[i];
          add_strip<kAlongU>(cell, kink + (end - kink) * root * root,
                             std::fabs(end - kink) * root * rule.weights[i]);
        }
      };
      if (at_from) add_from(from, at_to ? middle : to);
      if (at_to) add_from(to, at_from ? middle : from);
    }
  }

  /// One of them, `share` of the cell wide.
  template <bool kAlongU>
  void add_strip(const ChartCell& cell, double across, double share) {
    static const QuadratureRule rule = gauss_legendre(4);
    const auto u = [&](double along) { return cell.u + (kAlongU ? along : across) * cell.width; };
    const auto v = [&](double along) { return cell.v + (kAlongU ? across : along) * cell.height; };
    const auto valid = [&](double along) { return p_.valid(cell.chart, u(along), v(along)); };
    double inside = -1;
    for (const double along : {0.0, 1.0, 0.5, 0.25, 0.75}) {
      if (inside < 0 && valid(along)) inside = along;
    }
    if (inside < 0) return;
    const double from = valid(0) ? 0 : change(valid, inside, 0), to = valid(1) ? 1 : change(valid, inside, 1);
    const auto direction = [&](double along) { return p_.to_sphere(cell.chart, u(along), v(along)); };
    const double middle = (from + to) / 2;
    // From the middle to either end. The density may be infinite on the rim, as 1/√distance: with the
    // distance a square it is smooth.
    for (const double end : {from, to}) {
      const double area = (middle - from) * cell.width * cell.height * share;
      const int panels = 1 + static_cast<int>(length(direction(end) - direction(middle)) / limits_.side);
      for (int k = 0; k < 4 * panels; ++k) {
        const std::size_t i = static_cast<std::size_t>(k % 4);
        const double root = (k / 4 + 0.5 + 0.5 * rule.nodes[i]) / panels;
        const double along = end + (middle - end) * root * root;
        const double density = p_.solid_angle_density(cell.chart, u(along), v(along));
        points_.push_back({direction(along), density * area * rule.weights[i] * root / panels});
      }
    }
  }

  const AnyParameterization& p_;
  bool full_;
  CellLimits limits_;
  std::vector<TexelPoint>& points_;
};

}  // namespace

ChartCell ChartCell::part(int x, int columns, int y, int rows) const {
  return {chart, u + width * x / columns, v + height * y / rows, width / columns, height / rows};
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

}  // namespace welkin
