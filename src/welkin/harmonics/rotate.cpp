#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "welkin/base/error.h"
#include "welkin/harmonics/harmonics.h"

namespace welkin::harmonics {
namespace {

/// How functions of one degree turn: rows are the new orders −l … l, columns the old ones.
class DegreeMatrix {
 public:
  explicit DegreeMatrix(int degree)
      : degree_(degree), values_(static_cast<std::size_t>(count_of(2 * degree))) {}
  double& at(int m, int n) { return values_[place(m, n)]; }
  double at(int m, int n) const { return values_[place(m, n)]; }

 private:
  std::size_t place(int m, int n) const {
    return static_cast<std::size_t>((m + degree_) * (2 * degree_ + 1) + n + degree_);
  }
  int degree_;
  std::vector<double> values_;
};

/// That of degree 1 is the rotation itself, of the axes y, z, x.
DegreeMatrix first_degree(const Matrix3& rotation) {
  constexpr std::size_t kAxis[3] = {1, 2, 0};
  DegreeMatrix result(1);
  for (int m = -1; m <= 1; ++m) {
    for (int n = -1; n <= 1; ++n) result.at(m, n) = rotation.rows[kAxis[m + 1]][kAxis[n + 1]];
  }
  return result;
}

/// The functions U, V, W and P of Ivanic & Ruedenberg, table 2, of one degree.
class Step {
 public:
  Step(const DegreeMatrix& first, const DegreeMatrix& before, int degree)
      : first_(first), before_(before), l_(degree) {}

  DegreeMatrix next() const {
    DegreeMatrix result(l_);
    for (int m = -l_; m <= l_; ++m) {
      for (int n = -l_; n <= l_; ++n) result.at(m, n) = element(m, n);
    }
    return result;
  }

 private:
  double element(int m, int n) const {
    const int size = std::abs(m);
    const double across =
        std::abs(n) == l_ ? 2.0 * l_ * (2.0 * l_ - 1) : static_cast<double>((l_ + n) * (l_ - n));
    const double u = std::sqrt((l_ + m) * (l_ - m) / across);
    const double v =
        0.5 * std::sqrt((m == 0 ? 2 : 1) * (l_ + size - 1.0) * (l_ + size) / across) * (m == 0 ? -1 : 1);
    const double w = m == 0 ? 0 : -0.5 * std::sqrt((l_ - size - 1.0) * (l_ - size) / across);
    double sum = 0;
    if (u != 0) sum += u * p(0, m, n);
    if (v != 0) sum += v * v_part(m, n);
    if (w != 0) sum += w * w_part(m, n);
    return sum;
  }

  double v_part(int m, int n) const {
    if (m == 0) return p(1, 1, n) + p(-1, -1, n);
    if (m == 1) return std::sqrt(2.0) * p(1, 0, n);
    if (m == -1) return std::sqrt(2.0) * p(-1, 0, n);
    return m > 0 ? p(1, m - 1, n) - p(-1, 1 - m, n) : p(1, m + 1, n) + p(-1, -m - 1, n);
  }

  double w_part(int m, int n) const {
    return m > 0 ? p(1, m + 1, n) + p(-1, -m - 1, n) : p(1, m - 1, n) - p(-1, 1 - m, n);
  }

  double p(int i, int m, int n) const {
    if (n == l_) return first_.at(i, 1) * before_.at(m, l_ - 1) - first_.at(i, -1) * before_.at(m, 1 - l_);
    if (n == -l_) return first_.at(i, 1) * before_.at(m, 1 - l_) + first_.at(i, -1) * before_.at(m, l_ - 1);
    return first_.at(i, 0) * before_.at(m, n);
  }

  const DegreeMatrix& first_;
  const DegreeMatrix& before_;
  int l_;
};

}  // namespace

SphericalHarmonics rotated(const SphericalHarmonics& harmonics, const Matrix3& rotation) {
  require(is_orthonormal(rotation), "spherical harmonics are turned by a rotation or a reflection");
  if (rotation == Matrix3{}) return harmonics;
  SphericalHarmonics result = harmonics;
  const DegreeMatrix first = first_degree(orthonormalize(rotation));
  DegreeMatrix matrix = first;
  for (int l = 1; l <= harmonics.degree(); ++l) {
    if (l > 1) matrix = Step(first, matrix, l).next();
    for (int m = -l; m <= l; ++m) {
      for (int c = 0; c < harmonics.channels(); ++c) {
        double sum = 0;
        for (int n = -l; n <= l; ++n) sum += matrix.at(m, n) * harmonics.at(l, n, c);
        result.at(l, m, c) = sum;
      }
    }
  }
  return result;
}

}  // namespace welkin::harmonics
