#include "welkin/harmonics/longitude_rows.h"

#include <algorithm>
#include <cmath>

#include "welkin/math/angles.h"
#include "welkin/math/gauss_legendre.h"

namespace welkin::harmonics {
namespace {

/// Rows are latitudes and columns longitudes where positions agree with that to so much.
constexpr double kExact = 1e-11;

/// Nodes of the rows at a pole, where sin^m θ may be a root of v, and the least and the most of others.
constexpr int kPoleNodes = 24, kFewestNodes = 3, kMostNodes = 64;

double longitude_of(const Vec3d& d) {
  return std::atan2(d.x, d.z);
}

}  // namespace

std::optional<Longitudes> longitudes_of(const sphere::AnyParameterization& p) {
  if (p.traits().projection != sphere::Projection::panorama || !p.density_by_row() || !p.full_charts() ||
      p.charts() != 1) {
    return std::nullopt;
  }
  Longitudes result{longitude_of(p.to_sphere(0, 0.5, 0.5)), 0, false};
  const Vec3d left = p.to_sphere(0, 0.375, 0.5), right = p.to_sphere(0, 0.625, 0.5);
  result.width = 4 * std::remainder(longitude_of(left) - longitude_of(right), 2 * kPi);
  result.around = std::fabs(result.width - 2 * kPi) < 1e-9;
  if (result.around) result.width = 2 * kPi;
  for (const double v : {0.07, 0.31, 0.5, 0.83}) {
    const double height = p.to_sphere(0, 0.5, v).y, level = std::sqrt(std::max(0.0, 1 - height * height));
    for (const double u : {0.0, 0.23, 0.5, 0.71, 1.0}) {
      const double longitude = result.centre + result.width * (0.5 - u);
      const Vec3d expected{level * std::sin(longitude), height, level * std::cos(longitude)};
      if (length(p.to_sphere(0, u, v) - expected) > kExact) return std::nullopt;
    }
  }
  return result;
}

double column_factor(const Longitudes& longitudes, int columns, int m) {
  const double half = 0.5 * m * longitudes.width / columns;
  return (m == 0 ? 1 : std::sin(half) / half) / columns;
}

double column_longitude(const Longitudes& longitudes, int columns, int x) {
  return longitudes.centre + longitudes.width * (0.5 - (x + 0.5) / columns);
}

RowFactors::RowFactors(const sphere::AnyParameterization& parameterization, ChartSize size, int degree)
    : parameterization_(parameterization), size_(size), recurrence_(degree) {}

void RowFactors::of_row(int row, double* out) const {
  std::fill_n(out, RowIndex(recurrence_.degree).count(), 0.0);
  const double top = static_cast<double>(row) / size_.height, high = 1.0 / size_.height;
  const auto direction = [&](double v) { return parameterization_.to_sphere(0, 0.5, v); };
  const double angle = angle_between(direction(top), direction(top + high));
  // Gauss's rule of n nodes is exact to about (x/4)^2n/(2n)! for waves of x radians.
  const double waves = (recurrence_.degree + 2) * angle;
  int nodes = std::min(kMostNodes, kFewestNodes + static_cast<int>(std::ceil(0.75 * waves)));
  if (row == 0 || row == size_.height - 1) nodes = std::max(nodes, kPoleNodes);
  const QuadratureRule& rule = gauss_rule(nodes);
  for (std::size_t k = 0; k < rule.nodes.size(); ++k)
    add_node(top + high * (0.5 + 0.5 * rule.nodes[k]), 0.5 * high * rule.weights[k], out);
}

void RowFactors::add_node(double v, double weight, double* out) const {
  const Recurrence& r = recurrence_;
  const Vec3d d = parameterization_.to_sphere(0, 0.5, v);
  const double height = d.y, level = std::sqrt(d.x * d.x + d.z * d.z);
  double power = weight * parameterization_.solid_angle_density(0, 0.5, v);
  std::size_t k = 0, place = 0;
  for (int m = 0; m <= r.degree; ++m) {
    double now = r.first[static_cast<std::size_t>(m)] * power, before = 0;
    for (int l = m;; ++l) {
      out[place++] += now;
      if (l == r.degree) break;
      const double next = r.a[k] * (height * now - r.b[k] * before);
      before = now;
      now = next;
      ++k;
    }
    power *= level;
  }
}

}  // namespace welkin::harmonics
