#pragma once

#include <algorithm>
#include <cstdint>

namespace welkin {

/// `rows` rows cut into bands for parallel sums. The cut depends on `rows` alone, so sums that are added up
/// band after band are the same whatever the number of threads.
struct RowBands {
  int rows;
  int count;

  explicit RowBands(int row_count) : rows(row_count), count(std::min(row_count, kMaxCount)) {}

  /// Band i has the rows first(i) … first(i + 1) − 1.
  int first(int band) const { return static_cast<int>(static_cast<std::int64_t>(rows) * band / count); }

  static constexpr int kMaxCount = 64;
};

}  // namespace welkin
