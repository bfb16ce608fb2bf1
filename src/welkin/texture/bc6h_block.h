#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

/// Blocks of BC6H: 4×4 texels of three halves in 16 bytes. Internal to texture.
///
/// A block has one region or two, by a partition. Each region has two endpoints, stored as integers of the
/// mode's precision, most of them as differences from the first; texels are interpolated between them by an
/// index. Source: Khronos Data Format Specification 1.3, chapter 20 (BPTC); ARB_texture_compression_bptc.
namespace welkin::texture::bc6h {

inline constexpr int kModes = 14, kPartitions = 32, kTexels = 16;

/// What the modes differ in, numbered 0 … 13 for 1 … 14 of the specifications.
struct Mode {
  int code, code_bits;
  int regions;        ///< 1, with indices of 4 bits; 2, with indices of 3
  bool differences;   ///< whether endpoints but the first are stored as differences from it
  int precision;      ///< of endpoints, bits
  int other_bits[3];  ///< of stored endpoints but the first, for R, G, B

  constexpr int index_bits() const { return regions == 1 ? 4 : 3; }
};
extern const std::array<Mode, kModes> kModeTable;

/// Texels of the second region, a bit each; the anchor is that of its texels whose index has a bit less.
struct Partition {
  std::uint16_t second;
  int anchor;
};
extern const std::array<Partition, kPartitions> kPartitionTable;

/// Weights of the second endpoint by index, of 64.
inline constexpr int kWeights3[8] = {0, 9, 18, 27, 37, 46, 55, 64};
inline constexpr int kWeights4[16] = {0, 4, 9, 13, 17, 21, 26, 30, 34, 38, 43, 47, 51, 55, 60, 64};

/// What a block says.
struct Block {
  int mode = 0;
  int partition = 0;
  /// A and B of the first region, A and B of the second; each of the mode's precision, not as differences.
  int endpoints[4][3] = {};
  std::uint8_t indices[kTexels] = {};
};

/// Whether the block's differences can be stored: of a channel, and of all.
/// @{
bool fits(const Block& block, int channel);
bool fits(const Block& block);
/// @}

/// Of an unsigned format: an endpoint in 16 bits, 0 … 65535.
constexpr int unquantized(int value, int precision) {
  if (precision >= 15 || value == 0) return value;
  if (value == (1 << precision) - 1) return 0xffff;
  return ((value << 16) + 0x8000) >> precision;
}
/// Between two of these, as a half.
constexpr int interpolated(int a, int b, int weight) {
  return (((a * (64 - weight) + b * weight + 32) >> 6) * 31) >> 6;
}

/// Bytes of a block that fits, whose anchors' indices are below half.
void pack(const Block& block, std::byte* bytes);
/// Nothing for the codes of modes that there aren't. With `is_signed` endpoints are in two's complement.
bool unpack(const std::byte* bytes, bool is_signed, Block& block);

/// Halves of a block, R G B for each texel row by row. A reserved mode is black.
void decode(const std::byte* bytes, bool is_signed, std::uint16_t* halves);

}  // namespace welkin::texture::bc6h
