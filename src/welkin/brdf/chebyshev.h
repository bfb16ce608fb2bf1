#pragma once

#include <cmath>
#include <vector>

#include "welkin/math/scalar.h"

namespace welkin::brdf {

/// Chebyshev's points of the second kind on [0, 1], both ends included, and the barycentric formula of the
/// polynomial through values there. Berrut & Trefethen 2004, eq. 5.4.
class ChebyshevPoints {
 public:
  /// At least 2.
  explicit ChebyshevPoints(int count) {
    for (int i = 0; i < count; ++i) {
      const double sine = std::sin(0.5 * kPi * i / (count - 1));
      points_.push_back(sine * sine);
      const double end = i == 0 || i == count - 1 ? 0.5 : 1;
      weights_.push_back(i % 2 == 0 ? end : -end);
    }
  }

  const std::vector<double>& points() const { return points_; }

  /// Coefficients of the values, which sum to 1: the interpolated value at x is their weighted sum.
  void coefficients(double x, std::vector<double>& out) const {
    out.assign(points_.size(), 0);
    double sum = 0;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (x == points_[i]) {
        out.assign(points_.size(), 0);
        out[i] = 1;
        return;
      }
      out[i] = weights_[i] / (x - points_[i]);
      sum += out[i];
    }
    for (double& each : out) each /= sum;
  }

 private:
  std::vector<double> points_, weights_;
};

}  // namespace welkin::brdf
