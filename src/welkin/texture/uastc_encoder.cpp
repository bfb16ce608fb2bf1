#include "welkin/texture/uastc_encoder.h"

#include <algorithm>
#include <map>
#include <vector>

#include "welkin/texture/bc6h_block.h"

namespace welkin::texture::uastc {
namespace {

/// Indices into astc::kRangeTable.
enum Levels {
  k3 = 1,
  k4 = 2,
  k5 = 3,
  k6 = 4,
  k8 = 5,
  k12 = 7,
  k16 = 8,
  k40 = 12,
  k64 = 14,
  k80 = 15,
  k128 = 17,
  k192 = 19,
  k256 = 20
};

}  // namespace

const std::array<Shape, kShapes> kShapeTable = {{{1, 11, k16, k192},
                                                 {1, 11, k12, k256},
                                                 {1, 7, k16, k256},
                                                 {2, 7, k8, k80},
                                                 {2, 7, k6, k128},
                                                 {2, 7, k5, k192},
                                                 {2, 7, k4, k256},
                                                 {2, 7, k3, k256},
                                                 {2, 11, k4, k40},
                                                 {2, 11, k3, k64}}};

namespace {

/// The indices that weights become, in ascending order: of two regions' three bits, or of one region's four.
const std::vector<int>& bc6h_indices(int count) {
  static const std::map<int, std::vector<int>> all = {
      {3, {0, 4, 7}},
      {4, {0, 2, 5, 7}},
      {5, {0, 2, 4, 5, 7}},
      {6, {0, 1, 3, 4, 6, 7}},
      {8, {0, 1, 2, 3, 4, 5, 6, 7}},
      {12, {0, 1, 2, 4, 5, 6, 9, 10, 11, 13, 14, 15}},
      {16, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15}}};
  return all.at(count);
}

Weights weights_of(int range) {
  const int count = astc::kRangeTable[static_cast<std::size_t>(range)].levels;
  const auto& values = astc::weight_values(range);
  Weights weights;
  weights.count = count;
  for (int i = 0; i < count; ++i) weights.code[i] = static_cast<std::uint8_t>(i);
  std::sort(weights.code, weights.code + count, [&](int a, int b) {
    return values[static_cast<std::size_t>(a)] < values[static_cast<std::size_t>(b)];
  });
  const std::vector<int>& indices = bc6h_indices(count);
  for (int i = 0; i < count; ++i) {
    weights.weight[i] = values[weights.code[i]];
    weights.bc6h[i] = (count > 8 ? bc6h::kWeights4 : bc6h::kWeights3)[indices[static_cast<std::size_t>(i)]];
  }
  return weights;
}

/// Partitions of BC6H that ASTC has too, whichever of the regions it numbers first.
std::array<Partition, kPartitions> common_partitions() {
  std::array<Partition, kPartitions> found{};
  std::size_t count = 0;
  for (const bc6h::Partition& wanted : bc6h::kPartitionTable) {
    for (int seed = 0; seed < astc::kSeeds; ++seed) {
      const std::array<std::uint8_t, astc::kTexels> texels = astc::pattern(2, seed);
      unsigned second = 0;
      for (unsigned i = 0; i < astc::kTexels; ++i) second |= static_cast<unsigned>(texels[i]) << i;
      if (second != wanted.second && (second ^ 0xffff) != wanted.second) continue;
      found.at(count++) = {seed, second != wanted.second, static_cast<std::uint16_t>(second)};
      break;
    }
  }
  return found;
}

}  // namespace

const Tables& Tables::get() {
  static const Tables tables = [] {
    Tables made;
    made.partitions = common_partitions();
    std::vector<std::uint16_t> seconds;
    for (const Partition& each : made.partitions) seconds.push_back(each.second);
    made.masks = PartitionMasks::of(seconds);
    for (const int range : {k3, k4, k5, k6, k8, k12, k16})
      made.weights[static_cast<std::size_t>(range)] = weights_of(range);
    return made;
  }();
  return tables;
}

}  // namespace welkin::texture::uastc
