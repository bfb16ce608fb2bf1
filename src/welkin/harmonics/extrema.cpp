#include "welkin/harmonics/extrema.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "welkin/base/error.h"
#include "welkin/base/parallel.h"
#include "welkin/harmonics/recurrence.h"

namespace welkin::harmonics {
namespace {

using Vector = std::array<double, 3>;
using Symmetric = std::array<Vector, 3>;

/// Eigenvalues of a symmetric matrix, and eigenvectors as the columns of `vectors`, by Jacobi's rotations.
Vector eigenvalues(Symmetric m, Symmetric& vectors) {
  vectors = {Vector{1, 0, 0}, Vector{0, 1, 0}, Vector{0, 0, 1}};
  for (int sweep = 0; sweep < 30; ++sweep) {
    const double off = m[0][1] * m[0][1] + m[0][2] * m[0][2] + m[1][2] * m[1][2];
    const double diagonal = m[0][0] * m[0][0] + m[1][1] * m[1][1] + m[2][2] * m[2][2];
    if (off <= 1e-34 * (diagonal + off)) break;
    for (std::size_t p = 0; p < 2; ++p) {
      for (std::size_t q = p + 1; q < 3; ++q) {
        if (m[p][q] == 0) continue;
        const double ratio = (m[q][q] - m[p][p]) / (2 * m[p][q]);
        const double t = (ratio >= 0 ? 1 : -1) / (std::fabs(ratio) + std::sqrt(1 + ratio * ratio));
        const double c = 1 / std::sqrt(1 + t * t), s = t * c;
        for (std::size_t k = 0; k < 3; ++k) {
          const double a = m[k][p], b = m[k][q];
          m[k][p] = c * a - s * b;
          m[k][q] = s * a + c * b;
        }
        for (std::size_t k = 0; k < 3; ++k) {
          const double a = m[p][k], b = m[q][k];
          m[p][k] = c * a - s * b;
          m[q][k] = s * a + c * b;
        }
        for (std::size_t k = 0; k < 3; ++k) {
          const double a = vectors[k][p], b = vectors[k][q];
          vectors[k][p] = c * a - s * b;
          vectors[k][q] = s * a + c * b;
        }
      }
    }
  }
  return {m[0][0], m[1][1], m[2][2]};
}

/// The unit vector d for which dᵀ M d + b·d is least. With d = −(M − μ)⁻¹ b/2 in the eigenvectors' axes, its
/// length falls as μ falls from the least eigenvalue, where it is infinite unless b has no part there.
Vector least_direction(const Symmetric& matrix, const Vector& linear) {
  Symmetric vectors;
  const Vector values = eigenvalues(matrix, vectors);
  Vector b{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) b[i] += vectors[k][i] * linear[k];
  }
  const std::size_t least =
      static_cast<std::size_t>(std::min_element(values.begin(), values.end()) - values.begin());
  const double size = std::sqrt(b[0] * b[0] + b[1] * b[1] + b[2] * b[2]);
  const auto solution = [&](double below) {
    Vector d{};
    for (std::size_t i = 0; i < 3; ++i) {
      const double gap = 2 * (values[i] - values[least] + below);
      d[i] = gap > 0 ? -b[i] / gap : 0;
    }
    return d;
  };
  const auto square = [](const Vector& d) { return d[0] * d[0] + d[1] * d[1] + d[2] * d[2]; };
  // At half of |b| below the least eigenvalue no component is longer than its share of b.
  double near = 0, far = size / 2;
  for (int step = 0; step < 100 && near < far; ++step) {
    const double middle = near + (far - near) / 2;
    if (middle <= near || middle >= far) break;
    (square(solution(middle)) > 1 ? near : far) = middle;
  }
  Vector d = solution(far);
  // What is missing lies along the least eigenvector, on either side.
  const double missing = 1 - square(d);
  if (missing > 0) {
    const double part = std::sqrt(d[least] * d[least] + missing);
    d[least] = d[least] < 0 || (d[least] == 0 && b[least] > 0) ? -part : part;
  }
  Vector result{};
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < 3; ++i) result[k] += vectors[k][i] * d[i];
  }
  return result;
}

Vec3d least_of_quadric(const SphericalHarmonics& f, int channel) {
  const auto c = [&](int l, int m) { return l <= f.degree() ? f.at(l, m, channel) : 0; };
  const double one = std::sqrt(3 / (4 * kPi)), two = std::sqrt(15 / (4 * kPi)),
               zero = std::sqrt(5 / (16 * kPi));
  const double xy = two / 2 * c(2, -2), yz = two / 2 * c(2, -1), zx = two / 2 * c(2, 1),
               xx = two / 2 * c(2, 2);
  const Symmetric m{Vector{xx, xy, zx}, Vector{xy, -xx, yz}, Vector{zx, yz, 3 * zero * c(2, 0)}};
  const Vector d = least_direction(m, {one * c(1, 1), one * c(1, -1), one * c(1, 0)});
  return normalize(Vec3d{d[0], d[1], d[2]});
}

/// Minima of a grid that are refined, at most.
constexpr std::size_t kMostMinima = 64;

/// Points of the pattern that a minimum is followed with: 7×7, in three batches.
constexpr int kPattern = 7;

/// Rows at even steps of colatitude, the poles left out, and twice as many columns.
struct SphereGrid {
  explicit SphereGrid(int count) : rows(count), columns(2 * count) {
    for (int row = 0; row < rows; ++row) {
      const double colatitude = kPi * (row + 0.5) / rows;
      for (int column = 0; column < columns; ++column) {
        const double longitude = 2 * kPi * column / columns;
        directions.push_back({std::sin(colatitude) * std::cos(longitude),
                              std::sin(colatitude) * std::sin(longitude), std::cos(colatitude)});
      }
    }
  }
  /// Past a pole the row on the other side.
  std::size_t place(int row, int column) const {
    if (row < 0 || row >= rows) column += columns / 2;
    row = row < 0 ? 0 : row >= rows ? rows - 1 : row;
    return static_cast<std::size_t>(row * columns + (column % columns + columns) % columns);
  }
  int rows, columns;
  std::vector<Vec3d> directions;
};

/// Goes to the least point of a pattern, which then shrinks, or stays as large where that is at its edge.
Extremum refine(const ValuesOnSphere& function, Extremum from, double radius) {
  std::vector<Vec3d> pattern;
  std::vector<double> values;
  for (int step = 0; step < 200 && radius > 1e-9; ++step) {
    const Vec3d& d = from.direction;
    const Vec3d across = normalize(cross(d, std::fabs(d.y) < 0.9 ? Vec3d{0, 1, 0} : Vec3d{1, 0, 0}));
    const Vec3d up = cross(across, d);
    pattern.clear();
    for (int k = 0; k < kPattern * kPattern; ++k) {
      const double x = radius * (2.0 * (k % kPattern) / (kPattern - 1) - 1),
                   y = radius * (2.0 * (k / kPattern) / (kPattern - 1) - 1);
      pattern.push_back(normalize(d + x * across + y * up));
    }
    values.resize(pattern.size());
    function(pattern, values);
    const int best = static_cast<int>(std::min_element(values.begin(), values.end()) - values.begin());
    const int x = best % kPattern, y = best / kPattern;
    if (values[static_cast<std::size_t>(best)] < from.value)
      from = {pattern[static_cast<std::size_t>(best)], values[static_cast<std::size_t>(best)]};
    if (x > 0 && y > 0 && x < kPattern - 1 && y < kPattern - 1) radius *= 0.4;
  }
  return from;
}

/// Refines the minima of a grid's values that may lie over the least.
Extremum least_from_grid(const SphereGrid& grid, const std::vector<double>& values,
                         const ValuesOnSphere& function) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  // Between points of the grid a function falls by no more than (l·step)²/4 of what it spans.
  const double reach = *low + 0.2 * (*high - *low);
  std::vector<Extremum> minima;
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      const std::size_t here = grid.place(row, column);
      bool least = values[here] <= reach;
      for (int k = 0; k < 9 && least; ++k) {
        const std::size_t beside = grid.place(row + k / 3 - 1, column + k % 3 - 1);
        // Of a plateau, one.
        least = values[here] < values[beside] || (values[here] == values[beside] && here <= beside);
      }
      if (least) minima.push_back({grid.directions[here], values[here]});
    }
  }
  std::sort(minima.begin(), minima.end(),
            [](const Extremum& a, const Extremum& b) { return a.value < b.value; });
  if (minima.size() > kMostMinima) minima.resize(kMostMinima);
  Extremum best{grid.directions[static_cast<std::size_t>(low - values.begin())], *low};
  for (const Extremum& each : minima) {
    const Extremum refined = refine(function, each, kPi / grid.rows);
    if (refined.value < best.value) best = refined;
  }
  return best;
}

/// The values of one channel on a grid, row by row: sums over degrees, then over orders.
std::vector<double> values_on(const SphereGrid& grid, const SphericalHarmonics& f) {
  const int degree = f.degree();
  const Recurrence r(degree);
  std::vector<double> turns;
  for (int column = 0; column < grid.columns; ++column)
    turns.insert(turns.end(),
                 {std::cos(2 * kPi * column / grid.columns), std::sin(2 * kPi * column / grid.columns)});
  std::vector<double> values(grid.directions.size());
  parallel_for(grid.rows, [&](int row) {
    const Vec3d first = grid.directions[grid.place(row, 0)];
    double* out = &values[grid.place(row, 0)];
    double power = 1;
    std::size_t k = 0;
    for (int m = 0; m <= degree; ++m) {
      double now = r.first[static_cast<std::size_t>(m)] * power, before = 0, cosine = 0, sine = 0;
      for (int l = m;; ++l) {
        cosine += now * f.at(l, m, 0);
        sine += m > 0 ? now * f.at(l, -m, 0) : 0;
        if (l == degree) break;
        const double next = r.a[k] * (first.z * now - r.b[k] * before);
        before = now;
        now = next;
        ++k;
      }
      for (int column = 0; column < grid.columns; ++column) {
        const std::size_t turn = 2 * static_cast<std::size_t>(m * column % grid.columns);
        out[column] += cosine * turns[turn] + sine * turns[turn + 1];
      }
      power *= first.x;
    }
  });
  return values;
}

}  // namespace

Extremum minimum_on_sphere(const ValuesOnSphere& function, int degree) {
  const SphereGrid grid(4 * (degree + 1));
  std::vector<double> values(grid.directions.size());
  function(grid.directions, values);
  return least_from_grid(grid, values, function);
}

Extremum minimum_of(const SphericalHarmonics& harmonics, int channel) {
  require(channel >= 0 && channel < harmonics.channels(), "there is no such channel");
  SphericalHarmonics one(harmonics.degree(), 1);
  for (std::size_t i = 0; i < one.values().size(); ++i)
    one.values()[i] =
        harmonics
            .values()[i * static_cast<std::size_t>(harmonics.channels()) + static_cast<std::size_t>(channel)];
  Extremum result;
  if (one.degree() <= 2) {
    result.direction = least_of_quadric(one, 0);
    one.evaluate(result.direction, {&result.value, 1});
    return result;
  }
  const SphereGrid grid(4 * (one.degree() + 1));
  return least_from_grid(
      grid, values_on(grid, one),
      [&](std::span<const Vec3d> directions, std::span<double> values) { one.evaluate(directions, values); });
}

}  // namespace welkin::harmonics
