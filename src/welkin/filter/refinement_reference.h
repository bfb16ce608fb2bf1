#pragma once

#include <array>

#include "welkin/filter/refinement.h"

/// refinement.h in float64, one part after another. For tests.
namespace welkin {

/// m and the coefficients of x, y, x² − 1/12, x·y and y² − 1/12 within a texel, before its limiter.
std::array<double, 6> free_quadratic(const ImageView<const float>& chart, int x, int y, int channel);

class RefinementReference {
 public:
  RefinementReference(const sphere::AnyParameterization& source, const Level& level, int parts)
      : source_(source), level_(level), parts_(parts) {}

  /// The same within part (x, y) of a chart.
  std::array<double, 6> within(int chart, int x, int y, int channel) const;

 private:
  /// Of a texel, row by row.
  using Parts = std::array<double, kMostParts * kMostParts>;
  Parts means(int chart, int x, int y, int channel) const;
  Parts shares(int chart, int x, int y) const;

  const sphere::AnyParameterization& source_;
  const Level& level_;
  const int parts_;
};

}  // namespace welkin
