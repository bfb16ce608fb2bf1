#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "welkin/texture/astc_block.h"
#include "welkin/texture/error_scale.h"
#include "welkin/texture/uastc_endpoints.h"

/// The search for a block's best encoding as UASTC HDR 4×4: the blocks of ASTC that become blocks of BC6H
/// without being searched again. Internal to texture. Source: "UASTC HDR 4x4 Texture Specification" 1.1
/// (Binomial).
///
/// A block is of one colour, or has one partition or two, all of ASTC's HDR mode 11 (two colours) or 7 (a
/// colour and how much darker the other is); weights for all 16 texels, in one plane. Of two partitions only
/// those are used that BC6H has too.
namespace welkin::texture::uastc {

/// What a block can be: its partitions, its mode of endpoints, and the ranges of its weights and endpoints.
struct Shape {
  int partitions, mode, weight_range, endpoint_range;

  /// Values of a partition's endpoints.
  int values() const { return mode == 7 ? 4 : 6; }
};
/// Those that the specification allows and the search uses: of one partition fewer levels of weights gain
/// nothing.
enum ShapeIndex {
  kOneDirect16,
  kOneDirect12,
  kOneScale16,
  kTwoScale8,
  kTwoScale6,
  kTwoScale5,
  kTwoScale4,
  kTwoScale3,
  kTwoDirect4,
  kTwoDirect3,
  kShapes
};
extern const std::array<Shape, kShapes> kShapeTable;

/// Weights of a range in ascending order, and the codes that store them.
struct Weights {
  int count = 0;
  int weight[16] = {};
  int bc6h[16] = {};  ///< the weights that they become as BC6H
  std::uint8_t code[16] = {};
};

/// A partition by the lowest seed of ASTC's that makes it, and its second region's texels, a bit each.
struct Partition {
  int seed;
  bool swapped;  ///< whether BC6H's regions are the other way round
  std::uint16_t second;
};
inline constexpr int kPartitions = 27;

struct Tables {
  std::array<Partition, kPartitions> partitions;
  PartitionMasks masks;
  std::array<Weights, 9> weights;  ///< by range

  static const Tables& get();
};

/// How long the search is.
struct Search {
  int partitions;   ///< of the best by rank, that are tried
  bool all_shapes;  ///< of two partitions, those of few weights too
  int finer;        ///< layouts of endpoints that are tried beside the one they fit into
  int refined;      ///< of the best candidates, whose endpoints are fitted again to the weights
  int refits;       ///< at most so often
  int rounds;       ///< in which every value of the best one's endpoints is moved by a step
};

/// Encodes blocks of 4×4 texels of halves, R G B each, 0 … kLargestHalf, to 16 bytes each.
using EncodeBlocks = void (*)(const std::uint16_t* halves, std::size_t blocks, const Search& search,
                              std::byte* bytes);

EncodeBlocks encoder_baseline();
EncodeBlocks encoder_avx2();

}  // namespace welkin::texture::uastc
