#pragma once

#include <cstddef>
#include <cstdint>

#include "welkin/texture/bc6h_block.h"
#include "welkin/texture/error_scale.h"

/// The search for a block's best encoding. Internal to texture.
namespace welkin::texture::bc6h {

/// Of the 32 partitions.
const PartitionMasks& partition_masks();

using texture::ErrorScale;
using texture::kLargestHalf;

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
