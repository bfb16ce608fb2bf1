#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

/// ASTC's integer sequences: values below a number of levels that is 2ⁿ, 3·2ⁿ or 5·2ⁿ, whose trits are stored
/// five in 8 bits and whose quints three in 7. Internal to texture. Source: Khronos Data Format Specification
/// 1.3, section 23.12 and on.
namespace welkin::texture::astc {

/// A block's 128 bits, from the lowest of the first byte on.
struct Bits {
  std::uint64_t low = 0, high = 0;

  /// `count`: at most 32. Bits from 128 on are 0.
  unsigned take(int at, int count) const;
  void put(int at, int count, unsigned value);
  /// The last bit first.
  Bits reversed() const;

  static Bits load(const std::byte* bytes);
  void store(std::byte* bytes) const;
};

/// Ranges of values, by the index that both weights and endpoints have.
struct Range {
  int levels, trits, quints, bits;
};
inline constexpr int kRanges = 21;
extern const std::array<Range, kRanges> kRangeTable;
/// The index of a number of levels that there is.
int range_of(int levels);

/// Bits of `count` values.
int sequence_bits(int range, int count);

void read_sequence(const Bits& bits, int at, int range, std::span<std::uint8_t> values);
void write_sequence(Bits& bits, int at, int range, std::span<const std::uint8_t> values);

/// What stored values of endpoints mean, 0 … 255, and of weights, 0 … 64 (of the first twelve ranges).
/// @{
const std::array<std::uint8_t, 256>& endpoint_values(int range);
const std::array<std::uint8_t, 32>& weight_values(int range);
/// @}

}  // namespace welkin::texture::astc
