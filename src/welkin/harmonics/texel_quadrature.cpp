#include "welkin/harmonics/texel_quadrature.h"

#include <algorithm>
#include <cmath>

#include "welkin/math/angles.h"
#include "welkin/math/gauss_legendre.h"

namespace welkin::harmonics {
namespace {

/// Gauss's product rule of so many points a side serves sides of up to so many radians of the wave.
constexpr double kWaves[] = {0, 0, 0.12, 0.5, 1.2, 2.0, 3.0};
constexpr int kMostNodes = 6;

/// Waves to a side of a cell of four points, at the rim of a disc.
constexpr double kCellWaves = 0.3;

/// Two rules of the fourth order, Gauss's of 2×2 points and one of the corners and the middle, differ by no
/// more about the mean direction of a texel that is smooth and small.
constexpr double kSmooth = 3e-7;

/// How little halving a cell with a crease may change its solid angle and the middle of it, as a share of the
/// texel's; and how often it is halved.
constexpr double kTolerance = 1e-6;
constexpr int kDeepest = 9;

int nodes_for(double waves) {
  int nodes = 2;
  while (nodes <= kMostNodes && waves > kWaves[nodes]) ++nodes;
  return nodes;
}

/// Solid angle, and its first moments.
struct Moments {
  explicit Moments(const TexelPoint* points, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      solid_angle += points[i].solid_angle;
      first = first + points[i].solid_angle * points[i].direction;
    }
  }
  double solid_angle = 0;
  Vec3d first{0, 0, 0};
};

}  // namespace

TexelQuadrature::TexelQuadrature(const sphere::AnyParameterization& parameterization, ChartSize size,
                                 int degree)
    : p_(parameterization), size_(size), waves_(degree + 2), limits_(texel_limits(parameterization, size)) {
  limits_.side = kCellWaves / waves_;
  // A rim is as many texels long as a chart is wide: of small charts it has to be followed more closely.
  const int side = std::min(size.width, size.height);
  limits_.rim_depth = 1 + std::clamp(static_cast<int>(std::ceil(std::log2(1024.0 / side))), 0, 5);
}

void TexelQuadrature::corners(int chart, int y, std::vector<Vec3d>& directions) const {
  directions.clear();
  for (int down = 0; down < 2; ++down) {
    for (int x = 0; x <= size_.width; ++x)
      directions.push_back(p_.to_sphere(chart, static_cast<double>(x) / size_.width,
                                        static_cast<double>(y + down) / size_.height));
  }
}

void TexelQuadrature::append_product(const ChartCell& cell, int nodes,
                                     std::vector<TexelPoint>& points) const {
  if (nodes == 2) return append_gauss_points(p_, cell, points);
  const QuadratureRule& rule = gauss_rule(nodes);
  for (std::size_t j = 0; j < rule.nodes.size(); ++j) {
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      const double u = cell.u + cell.width * (0.5 + 0.5 * rule.nodes[i]),
                   v = cell.v + cell.height * (0.5 + 0.5 * rule.nodes[j]);
      const double area = 0.25 * rule.weights[i] * rule.weights[j] * cell.width * cell.height;
      points.push_back({p_.to_sphere(cell.chart, u, v), area * p_.solid_angle_density(cell.chart, u, v)});
    }
  }
}

void TexelQuadrature::refine(const ChartCell& cell, int nodes, double tolerance, int depth, std::size_t first,
                             std::vector<TexelPoint>& points) const {
  const Moments coarse(&points[first], points.size() - first);
  std::vector<TexelPoint> fine;
  std::size_t ends[4];
  for (int k = 0; k < 4; ++k) {
    append_product(cell.part(k % 2, 2, k / 2, 2), nodes, fine);
    ends[k] = fine.size();
  }
  const Moments finer(fine.data(), fine.size());
  const double change =
      std::max(std::fabs(finer.solid_angle - coarse.solid_angle), length(finer.first - coarse.first));
  if (change <= tolerance || depth == kDeepest) return;
  points.resize(first);
  for (int k = 0; k < 4; ++k) {
    const std::size_t from = points.size();
    points.insert(points.end(), fine.begin() + (k == 0 ? 0 : static_cast<std::ptrdiff_t>(ends[k - 1])),
                  fine.begin() + static_cast<std::ptrdiff_t>(ends[k]));
    refine(cell.part(k % 2, 2, k / 2, 2), nodes, tolerance, depth + 1, from, points);
  }
}

void TexelQuadrature::of_row(int chart, int y, RowPoints& row) const {
  row.points.clear();
  row.ends.clear();
  const bool full = p_.full_charts();
  const std::vector<TexelKind> kinds = texel_kinds(p_, size_, chart, y);
  std::vector<Vec3d> around;
  corners(chart, y, around);
  const std::size_t next = static_cast<std::size_t>(size_.width) + 1;
  const double tolerance = kTolerance * std::pow(mean_texel(p_, size_), 2);
  for (int x = 0; x < size_.width; ++x) {
    const std::size_t i = static_cast<std::size_t>(x);
    const ChartCell cell = texel_cell(size_, chart, x, y);
    const Vec3d &a = around[i], &b = around[i + 1], &c = around[next + i], &d = around[next + i + 1];
    const double side = std::max({length(a - b), length(c - d), length(a - c), length(b - d)});
    const auto at = [&](double across, double down) {
      return p_.to_sphere(chart, cell.u + across * cell.width, cell.v + down * cell.height);
    };
    const Vec3d gauss = 0.25 * (at(kGauss[0], kGauss[0]) + at(kGauss[1], kGauss[0]) +
                                at(kGauss[0], kGauss[1]) + at(kGauss[1], kGauss[1]));
    const Vec3d other = 2.0 / 3 * at(0.5, 0.5) + 1.0 / 12 * (a + b + c + d);
    const bool smooth = kinds[i] == TexelKind::plain && length(gauss - other) <= kSmooth;
    const int nodes = nodes_for(waves_ * side);
    if (smooth && nodes <= kMostNodes) {
      append_product(cell, nodes, row.points);
    } else if (full) {
      // As many parts as leave each with few waves; each is then refined.
      const int parts =
          nodes <= kMostNodes ? 1 : static_cast<int>(std::ceil(waves_ * side / kWaves[kMostNodes]));
      for (int k = 0; k < parts * parts; ++k) {
        const ChartCell part = cell.part(k % parts, parts, k / parts, parts);
        const std::size_t first = row.points.size();
        append_product(part, std::min(nodes, kMostNodes), row.points);
        refine(part, std::min(nodes, kMostNodes), tolerance, 0, first, row.points);
      }
    } else if (kinds[i] != TexelKind::outside) {
      append_points(p_, cell, limits_, row.points);
    }
    row.ends.push_back(static_cast<int>(row.points.size()));
  }
}

double TexelQuadrature::longest_side() const {
  double longest = 0;
  std::vector<Vec3d> around;
  const std::size_t next = static_cast<std::size_t>(size_.width) + 1;
  for (int chart = 0; chart < p_.charts(); ++chart) {
    for (int y = 0; y < size_.height; ++y) {
      corners(chart, y, around);
      for (std::size_t x = 0; x + 1 < next; ++x) {
        if (!p_.valid(chart, (static_cast<double>(x) + 0.5) / size_.width, (y + 0.5) / size_.height))
          continue;
        const Vec3d &a = around[x], &b = around[x + 1], &c = around[next + x], &d = around[next + x + 1];
        for (const double side :
             {angle_between(a, b), angle_between(c, d), angle_between(a, c), angle_between(b, d)})
          longest = std::max(longest, side);
      }
    }
  }
  return longest;
}

}  // namespace welkin::harmonics
