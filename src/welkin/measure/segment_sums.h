#pragma once

#include <algorithm>
#include <cstddef>

/// Internal to measure.
namespace welkin {

/// Sums over a segment, in float: 16 values to a lane at most.
struct SegmentSums {
  bool plain = false;  ///< all values are finite and none is negative: else the others mean nothing
  float maximum = 0;
  double channels[4] = {};
};

/// Four texels at a time, so that lanes are packs of any instruction set.
template <int kChannels>
SegmentSums sum_lanes(const float* texels, const float* weights, int size) {
  constexpr int kLanes = 4 * kChannels;
  float sums[kLanes] = {}, low[kLanes] = {}, high[kLanes] = {}, zero[kLanes] = {};
  const auto add = [&](const float* from, const float* weight) {
    float spread[kLanes];
    for (int k = 0; k < kLanes; ++k) spread[k] = weight[k / kChannels];
    for (int k = 0; k < kLanes; ++k) {
      sums[k] += from[k] * spread[k];
      low[k] = from[k] < low[k] ? from[k] : low[k];
      high[k] = from[k] > high[k] ? from[k] : high[k];
      zero[k] += from[k] * 0.0f;
    }
  };
  int x = 0;
  for (; x + 4 <= size; x += 4) add(texels + std::ptrdiff_t{x} * kChannels, weights + x);
  if (x < size) {
    float rest[kLanes] = {}, weight[4] = {};
    std::copy(texels + std::ptrdiff_t{x} * kChannels, texels + std::ptrdiff_t{size} * kChannels, rest);
    std::copy(weights + x, weights + size, weight);
    add(rest, weight);
  }
  SegmentSums result;
  result.plain = true;
  for (int k = 0; k < kLanes; ++k) {
    result.plain = result.plain && low[k] >= 0 && zero[k] == 0;
    result.maximum = std::max(result.maximum, high[k]);
    result.channels[k % kChannels] += static_cast<double>(sums[k]);
  }
  return result;
}

inline SegmentSums sum_segment(const float* texels, const float* weights, int size, int channels) {
  switch (channels) {
    case 1:
      return sum_lanes<1>(texels, weights, size);
    case 2:
      return sum_lanes<2>(texels, weights, size);
    case 3:
      return sum_lanes<3>(texels, weights, size);
    case 4:
      return sum_lanes<4>(texels, weights, size);
    default:
      return {};
  }
}

}  // namespace welkin
