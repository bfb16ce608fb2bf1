#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "welkin/texture/astc_sequence.h"

/// Blocks of ASTC, 4×4 texels in 16 bytes, as the HDR profile reads them. Internal to texture.
///
/// A block has one to four partitions, by a hashed pattern; each has two endpoints, of one of sixteen modes.
/// Texels are interpolated between them by weights, which are stored for a grid of at most 4×4 points; with
/// two planes one channel has weights of its own. Or the block is of one colour, a void extent. Source:
/// Khronos Data Format Specification 1.3, chapter 23.
namespace welkin::texture::astc {

inline constexpr int kSide = 4, kTexels = 16, kBlockBytes = 16;
inline constexpr int kMaxPartitions = 4, kSeeds = 1024;

/// What a block says.
struct Block {
  bool one_colour = false;
  bool hdr_colour = true;        ///< of one colour: halves; else 65535 for 1
  std::uint16_t colour[4] = {};  ///< of one colour

  int grid_width = kSide, grid_height = kSide;
  int weight_range = 0;
  bool two_planes = false;
  int second_channel = 0;  ///< that the second plane's weights are for

  int partitions = 1;
  int seed = 0;  ///< of their pattern
  int modes[kMaxPartitions] = {};
  int endpoint_range = 0;

  std::uint8_t endpoints[18] = {};         ///< as they are stored, partition after partition
  std::uint8_t weights[2 * kTexels] = {};  ///< as they are stored; of two planes alternating

  int weight_count() const { return grid_width * grid_height * (two_planes ? 2 : 1); }
  int endpoint_count() const;
};

/// False for what the specification calls an illegal encoding, of blocks of 4×4.
bool unpack(const std::byte* bytes, Block& block);

/// Bytes of a block that `unpack` gives back. Of several partitions all have the same mode, and there is one
/// plane; the endpoints' range is the one that is left for them (endpoint_range_of).
void pack(const Block& block, std::byte* bytes);

/// The range that the bits left over by all else give to endpoints; -1 when they are too few for any.
int endpoint_range_of(const Block& block);

/// The partition of each texel, row by row.
std::array<std::uint8_t, kTexels> pattern(int partitions, int seed);

/// The half that a logarithm of 16 bits stands for, at most 65504.
constexpr std::uint16_t half_of_logarithm(int value) {
  const int exponent = value >> 11, mantissa = value & 0x7ff;
  const int scaled = mantissa < 512    ? 3 * mantissa
                     : mantissa < 1536 ? 4 * mantissa - 512
                                       : 5 * mantissa - 2048;
  const int half = (exponent << 10) + (scaled >> 3);
  return static_cast<std::uint16_t>(half > 0x7bff ? 0x7bff : half);
}

/// Halves of a block, R G B A for each texel row by row. An illegal one is magenta: 1, 0, 1, 1.
void decode(const std::byte* bytes, std::uint16_t* halves);

}  // namespace welkin::texture::astc
