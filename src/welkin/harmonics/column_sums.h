#pragma once

#include <cstddef>

/// Sums along rows of texels. Internal to harmonics.
namespace welkin::harmonics {

/// Rows that are summed together, so that each value of a table serves all of them.
inline constexpr int kRows = 4;

/// Texels that are added up side by side, and so many times before the sums are added in double: each float
/// sum has 32 terms.
inline constexpr int kColumns = 4, kTerms = 32;

/// sums[row·kChannels + c] = Σ_x rows[row][x·kChannels + c] · table[x·kChannels + c]. `columns` is a multiple
/// of kColumns.
template <int kChannels>
void sum_columns(const float* const* rows, const float* table, int columns, double* sums) {
  constexpr int kLanes = kColumns * kChannels;
  for (int i = 0; i < kRows * kChannels; ++i) sums[i] = 0;
  for (int from = 0; from < columns; from += kColumns * kTerms) {
    const int to = from + kColumns * kTerms < columns ? from + kColumns * kTerms : columns;
    float lanes[kRows][static_cast<std::size_t>(kLanes)] = {};
    for (int x = from; x < to; x += kColumns) {
      const float* factors = table + static_cast<std::ptrdiff_t>(x) * kChannels;
      for (int row = 0; row < kRows; ++row) {
        const float* values = rows[row] + static_cast<std::ptrdiff_t>(x) * kChannels;
        for (int k = 0; k < kLanes; ++k) lanes[row][k] += values[k] * factors[k];
      }
    }
    for (int row = 0; row < kRows; ++row) {
      for (int k = 0; k < kLanes; ++k)
        sums[row * kChannels + k % kChannels] += static_cast<double>(lanes[row][k]);
    }
  }
}

}  // namespace welkin::harmonics
