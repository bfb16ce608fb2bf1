#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "welkin/harmonics/harmonics.h"

/// Real spherical harmonics at many points. Internal to harmonics.
///
/// With x + iy = sin θ e^{iφ}, Y_lm = Q_lm(z) Re (x + iy)^m and Y_l,−m = Q_lm(z) Im (x + iy)^m, where the
/// polynomials Q_lm = √2 P̄_lm / sin^m θ (without √2 for m = 0) follow
///
///   Q_lm = a_lm (z Q_l−1,m − b_lm Q_l−2,m),  a_lm = √((4l² − 1)/(l² − m²)),  b_lm = 1/a_l−1,m.
///
/// Powers of x + iy hold all that is singular at the poles.
namespace welkin::harmonics {

/// Factors of the recurrence up to a degree.
struct Recurrence {
  explicit Recurrence(int max_degree);

  int degree;
  std::vector<double> first;  ///< Q_mm
  /// a_lm and b_lm, order after order: l = m + 1 … degree of m = 0, then of m = 1….
  std::vector<double> a, b;
};

/// Points that are evaluated together.
inline constexpr int kPoints = 64;

/// Up to kPoints unit directions; those past the last are to be finite.
struct PointBatch {
  alignas(64) double x[kPoints], y[kPoints], z[kPoints];
  int count = 0;
};

/// visit(index_of(l, m), y), order by order, with the values y of Y_lm at all kPoints.
template <class Visit>
void visit_functions(const Recurrence& r, const PointBatch& points, const Visit& visit) {
  alignas(64) double real[kPoints], imaginary[kPoints], now[kPoints], before[kPoints], values[kPoints];
  std::fill_n(real, kPoints, 1.0);
  std::fill_n(imaginary, kPoints, 0.0);
  std::size_t k = 0;
  for (int m = 0; m <= r.degree; ++m) {
    std::fill_n(now, kPoints, r.first[static_cast<std::size_t>(m)]);
    std::fill_n(before, kPoints, 0.0);
    for (int l = m;; ++l) {
      for (int i = 0; i < kPoints; ++i) values[i] = now[i] * real[i];
      visit(index_of(l, m), static_cast<const double*>(values));
      if (m > 0) {
        for (int i = 0; i < kPoints; ++i) values[i] = now[i] * imaginary[i];
        visit(index_of(l, -m), static_cast<const double*>(values));
      }
      if (l == r.degree) break;
      const double a = r.a[k], b = r.b[k];
      ++k;
      for (int i = 0; i < kPoints; ++i) {
        const double next = a * (points.z[i] * now[i] - b * before[i]);
        before[i] = now[i];
        now[i] = next;
      }
    }
    for (int i = 0; i < kPoints; ++i) {
      const double next = real[i] * points.x[i] - imaginary[i] * points.y[i];
      imaginary[i] = real[i] * points.y[i] + imaginary[i] * points.x[i];
      real[i] = next;
    }
  }
}

/// Sum of a[i] b[i] over a batch, in lanes.
inline double dot_points(const double* a, const double* b) {
  double lanes[8] = {};
  for (int i = 0; i < kPoints; i += 8) {
    for (int k = 0; k < 8; ++k) lanes[k] += a[i + k] * b[i + k];
  }
  return ((lanes[0] + lanes[4]) + (lanes[1] + lanes[5])) + ((lanes[2] + lanes[6]) + (lanes[3] + lanes[7]));
}

}  // namespace welkin::harmonics
