#include "welkin/texture/bc6h_encoder.h"

#include <algorithm>
#include <array>

namespace welkin::texture::bc6h {

const PartitionMasks& partition_masks() {
  static const PartitionMasks masks = [] {
    std::array<std::uint16_t, kPartitions> partitions;
    std::transform(kPartitionTable.begin(), kPartitionTable.end(), partitions.begin(),
                   [](const Partition& each) { return each.second; });
    return PartitionMasks::of(partitions);
  }();
  return masks;
}

}  // namespace welkin::texture::bc6h
