#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "welkin/texture/bc6h_block.h"

/// The search for a block's best encoding. Internal to texture.
namespace welkin::texture::bc6h {

/// How errors are judged: the squared difference of ln(v + 0.01), which is relative where there is light and
/// absolute where there is none. Alone, ln(v + 1) would ruin the relative error, and v would push dark texels
/// beside bright ones to black.
struct ErrorScale {
  std::array<float, kLargestHalf + 1> log;    ///< of each half
  std::array<float, kLargestHalf + 1> slope;  ///< its derivative squared, per step of a half

  static const ErrorScale& get();
};

/// Texels of the second region, 1 or 0, texel by texel for all partitions.
struct PartitionMasks {
  alignas(64) std::array<std::array<float, kPartitions>, kTexels> second;

  static const PartitionMasks& get();
};

/// How long the search is.
struct Search {
  int partitions;  ///< of the best by rank, that are tried
  int modes;       ///< of two regions, that are refined for each partition
  int refits;      ///< least squares after indices are chosen, again at most so often
  bool descend;    ///< every candidate's endpoints are moved by single steps while that helps, else those of
                   ///< the best
  bool perturb;    ///< the best one's are moved with the indices chosen again
};

/// Encodes blocks of 4×4 texels of halves, R G B each, 0 … kLargestHalf, to 16 bytes each.
using EncodeBlocks = void (*)(const std::uint16_t* halves, std::size_t blocks, const Search& search,
                              std::byte* bytes);

EncodeBlocks encoder_baseline();
EncodeBlocks encoder_avx2();

}  // namespace welkin::texture::bc6h
