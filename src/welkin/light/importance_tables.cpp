#include "welkin/light/importance_tables.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace welkin::light {

Cdf::Cdf(std::uint32_t count, std::uint32_t size)
    : size_(size),
      // A power of two: u · buckets is exact, so the guide can't be off by one.
      buckets_(std::bit_ceil(size)),
      sums_(static_cast<std::size_t>(count) * (size + 1)),
      guide_(static_cast<std::size_t>(count) * (buckets_ + 1)) {}

void Cdf::set(std::uint32_t k, const std::vector<double>& weights) {
  double* sums = &sums_[static_cast<std::size_t>(k) * (size_ + 1)];
  double sum = 0;
  for (std::uint32_t i = 0; i < size_; ++i) sums[i + 1] = sum += weights[i];
  if (!(sum > 0)) {
    std::fill_n(sums, size_ + 1, 0.0);
    return;
  }
  for (std::uint32_t i = 1; i <= size_; ++i) sums[i] /= sum;

  std::uint32_t* guide = &guide_[static_cast<std::size_t>(k) * (buckets_ + 1)];
  std::uint32_t i = 0;
  for (std::uint32_t bucket = 0; bucket <= buckets_; ++bucket) {
    const double from = static_cast<double>(bucket) / buckets_;
    while (i + 1 < size_ && sums[i + 1] <= from) ++i;
    guide[bucket] = i;
  }
}

Cdf::Found Cdf::find(std::uint32_t k, double u) const {
  const double* sums = sums_of(k);
  const std::uint32_t bucket = static_cast<std::uint32_t>(u * buckets_);
  const std::uint32_t* guide = &guide_[static_cast<std::size_t>(k) * (buckets_ + 1) + bucket];
  // A bucket holds the end of about one value: two steps without a branch mostly suffice.
  std::size_t i = guide[0];
  i += sums[i + 1] <= u ? 1 : 0;
  i += sums[i + 1] <= u ? 1 : 0;
  if (sums[i + 1] <= u)
    i = static_cast<std::size_t>(std::upper_bound(sums + i + 2, sums + guide[1] + 1, u) - sums) - 1;
  const double from = sums[i], probability = sums[i + 1] - from;
  return {static_cast<std::uint32_t>(i), std::min((u - from) / probability, kBelowOne), probability};
}

double Cdf::probability(std::uint32_t k, std::uint32_t index) const {
  const double* sums = sums_of(k) + index;
  return sums[1] - sums[0];
}

Choice RowColumnTable::choose(double u1, double u2) const {
  const Cdf::Found row = marginal_.find(0, u2);
  const Cdf::Found column = conditional_.find(row.index, u1);
  return {row.index, column.index, column.rest, row.rest, row.probability * column.probability};
}

AliasTable::AliasTable(std::uint32_t width, std::vector<double> weights)
    : width_(width), entries_(weights.size()) {
  const std::size_t count = weights.size();
  double sum = 0;
  for (const double weight : weights) sum += weight;
  // In units of an entry: below 1 there is room for a part of a larger one.
  std::vector<std::uint32_t> small, large;
  std::uint32_t largest = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const auto index = static_cast<std::uint32_t>(i);
    if (weights[i] > weights[largest]) largest = index;
    weights[i] *= static_cast<double>(count) / sum;
    (weights[i] < 1 ? small : large).push_back(index);
  }
  for (std::size_t next = 0; next < small.size(); ++next) {
    const std::uint32_t i = small[next];
    Entry& entry = entries_[i];
    entry.threshold = static_cast<float>(weights[i]);
    // Rounding can leave one without a partner: nearly 1 of its own, or nothing.
    entry.alias = large.empty() ? (weights[i] > 0 ? i : largest) : large.back();
    if (large.empty()) continue;
    double& rest = weights[large.back()];
    rest -= 1 - weights[i];
    if (rest < 1) {
      small.push_back(large.back());
      large.pop_back();
    }
  }
  for (const std::uint32_t i : large) entries_[i] = {1, i, 0, 0};

  // The probabilities that these thresholds have.
  std::vector<double>& own = weights;
  std::fill(own.begin(), own.end(), 0.0);
  for (std::size_t i = 0; i < count; ++i) {
    const double threshold = static_cast<double>(entries_[i].threshold);
    own[i] += threshold;
    own[entries_[i].alias] += 1 - threshold;
  }
  for (std::size_t i = 0; i < count; ++i) {
    Entry& entry = entries_[i];
    entry.own = static_cast<float>(own[i] / static_cast<double>(count));
    entry.others = static_cast<float>(own[entry.alias] / static_cast<double>(count));
  }
}

Choice AliasTable::choose(double u1, double u2) const {
  const double scaled = u1 * static_cast<double>(entries_.size());
  const std::size_t i = std::min(static_cast<std::size_t>(scaled), entries_.size() - 1);
  const Entry& entry = entries_[i];
  const double rest = std::min(scaled - static_cast<double>(i), kBelowOne);
  const double threshold = static_cast<double>(entry.threshold);
  const bool own = rest < threshold;
  const std::uint32_t chosen = own ? static_cast<std::uint32_t>(i) : entry.alias;
  const double s = own ? rest / threshold : (rest - threshold) / (1 - threshold);
  return {chosen / width_, chosen % width_, std::min(s, kBelowOne), u2,
          static_cast<double>(own ? entry.own : entry.others)};
}

}  // namespace welkin::light
