#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "welkin/base/large_memory.h"

/// Tables that choose a texel by its probability. Internal to ImportanceSampler. Rows of all charts stand one
/// under the other.
namespace welkin::light {

/// Values in huge pages, all bytes 0 at first: draws are at random places, and would miss the TLB in small
/// ones.
template <class T>
class LargeArray {
 public:
  explicit LargeArray(std::size_t count)
      : memory_(count * sizeof(T), LargeMemory::Contents::zero), count_(count) {}

  std::size_t size() const { return count_; }
  T& operator[](std::size_t i) { return reinterpret_cast<T*>(memory_.data())[i]; }
  const T& operator[](std::size_t i) const { return reinterpret_cast<const T*>(memory_.data())[i]; }

 private:
  LargeMemory memory_;
  std::size_t count_;
};

/// A texel that was chosen, what is left of the two numbers, each again in [0, 1), and its probability.
struct Choice {
  std::uint32_t row, column;
  double s, t;
  double probability;
};

/// The largest number below 1.
inline constexpr double kBelowOne = 1 - 0x1p-53;

/// A distribution by inversion of its cumulative sums, with a guide: in which part of them to search
/// (Chen & Asau 1974).
class Cdf {
 public:
  /// Room for distributions of `size` values each.
  Cdf(std::uint32_t count, std::uint32_t size);

  /// Of distribution k: weights ≥ 0 of any sum; all 0 where the sum is.
  void set(std::uint32_t k, const std::vector<double>& weights);

  struct Found {
    std::uint32_t index;
    double rest;  ///< in [0, 1)
    double probability;
  };
  /// By u in [0, 1), of a distribution whose sum isn't 0. What has no probability is never found.
  Found find(std::uint32_t k, double u) const;
  double probability(std::uint32_t k, std::uint32_t index) const;
  /// Where a value's part of [0, 1] ends.
  double end(std::uint32_t k, std::uint32_t index) const { return sums_of(k)[index + 1]; }

 private:
  const double* sums_of(std::uint32_t k) const { return &sums_[static_cast<std::size_t>(k) * (size_ + 1)]; }

  std::uint32_t size_, buckets_;
  LargeArray<double> sums_;  ///< size + 1 for each, from 0 to 1
  std::vector<std::uint32_t>
      guide_;  ///< buckets + 1 for each: the first value that ends beyond the bucket's start
};

/// Row by the marginal distribution, column by the row's.
class RowColumnTable {
 public:
  RowColumnTable(std::uint32_t rows, std::uint32_t width) : marginal_(1, rows), conditional_(rows, width) {}

  /// A row's weights, before `finish`; rows of all threads.
  void set_row(std::uint32_t row, const std::vector<double>& weights) { conditional_.set(row, weights); }
  void finish(const std::vector<double>& row_weights) { marginal_.set(0, row_weights); }

  Choice choose(double u1, double u2) const;
  double probability(std::uint32_t row, std::uint32_t column) const {
    return marginal_.probability(0, row) * conditional_.probability(row, column);
  }
  const Cdf& marginal() const { return marginal_; }
  const Cdf& conditional() const { return conditional_; }

 private:
  Cdf marginal_, conditional_;
};

/// Alias table (Walker 1977, by the construction of Vose 1991), all that a draw needs in 16 bytes.
class AliasTable {
 public:
  struct Entry {
    float threshold;
    std::uint32_t alias;
    float own,
        others;  ///< probabilities of the texel and of its alias, those that the table as it is stored has
  };

  /// Of weights ≥ 0 with a sum above 0.
  AliasTable(std::uint32_t width, std::vector<double> weights);

  Choice choose(double u1, double u2) const;
  double probability(std::uint32_t row, std::uint32_t column) const {
    return static_cast<double>(entry(row, column).own);
  }
  const Entry& entry(std::uint32_t row, std::uint32_t column) const {
    return entries_[static_cast<std::size_t>(row) * width_ + column];
  }

 private:
  std::uint32_t width_;
  LargeArray<Entry> entries_;
};

}  // namespace welkin::light
