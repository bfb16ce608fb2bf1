#pragma once

#include <array>
#include <cstdint>
#include <span>

/// What the searches for blocks of halves have in common. Internal to texture.
namespace welkin::texture {

/// The largest value of a half: 65504.
inline constexpr int kLargestHalf = 0x7bff;

/// How errors are judged: the squared difference of ln(v + 0.01), which is relative where there is light and
/// absolute where there is none. Alone, ln(v + 1) would ruin the relative error, and v would push dark texels
/// beside bright ones to black.
struct ErrorScale {
  std::array<float, kLargestHalf + 1> log;    ///< of each half
  std::array<float, kLargestHalf + 1> slope;  ///< its derivative squared, per step of a half

  static const ErrorScale& get();
};

/// Texels of the second region, 1 or 0, texel by texel for all partitions that are ranked.
inline constexpr int kRankedPartitions = 32;
struct PartitionMasks {
  alignas(64) std::array<std::array<float, kRankedPartitions>, 16> second;

  /// Of partitions by bits; those that aren't given have no second region.
  static PartitionMasks of(std::span<const std::uint16_t> partitions);
};

}  // namespace welkin::texture
