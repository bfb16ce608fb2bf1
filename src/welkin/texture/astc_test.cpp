#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <random>
#include <set>
#include <vector>

#include "welkin/base/error.h"
#include "welkin/texture/astc_block.h"
#include "welkin/texture/astc_endpoints.h"
#include "welkin/texture/astc_hdr.h"

namespace welkin {
namespace {

using namespace texture::astc;

constexpr std::uint16_t kOne = 0x3c00;

using Bytes = std::array<std::byte, kBlockBytes>;
using Halves = std::array<std::uint16_t, 4 * kTexels>;

Bytes bytes_of(const Bits& bits) {
  Bytes bytes;
  bits.store(bytes.data());
  return bytes;
}

Halves decoded(const Bits& bits) {
  Halves halves;
  decode(bytes_of(bits).data(), halves.data());
  return halves;
}

bool is_error(const Halves& halves) {
  constexpr std::uint16_t kMagenta[4] = {kOne, 0, kOne, kOne};
  for (std::size_t i = 0; i < halves.size(); ++i) {
    if (halves[i] != kMagenta[i % 4]) return false;
  }
  return true;
}

/// The numbers of bits that the specification's formula gives, and what was written.
TEST(AstcSequence, ReadsWhatItWrote) {
  std::mt19937 random(1);
  for (int range = 0; range < kRanges; ++range) {
    const Range& r = kRangeTable[static_cast<std::size_t>(range)];
    for (std::size_t count = 1; count <= 18; ++count) {
      const int length = sequence_bits(range, static_cast<int>(count));
      EXPECT_EQ(length, std::ceil(static_cast<double>(count) * 8 * r.trits / 5) +
                            std::ceil(static_cast<double>(count) * 7 * r.quints / 3) +
                            static_cast<double>(count) * r.bits);
      if (length > 100) continue;
      std::vector<std::uint8_t> values(count), again(count);
      for (auto& each : values) each = static_cast<std::uint8_t>(random() % static_cast<unsigned>(r.levels));
      Bits bits;
      write_sequence(bits, 17, range, values);
      read_sequence(bits, 17, range, again);
      EXPECT_EQ(values, again) << r.levels << " levels";
      for (int at = 0; at < 128; ++at)
        EXPECT_FALSE((at < 17 || at >= 17 + length) && bits.take(at, 1) != 0) << r.levels << " " << at;
    }
  }
}

/// Every code of five trits and of three quints is one of the 243 and 125 combinations, and each has a code.
TEST(AstcSequence, HasACodeForEveryCombination) {
  for (const auto& [levels, count, base] : {std::array{3, 5, 3}, std::array{5, 3, 5}}) {
    std::set<std::vector<std::uint8_t>> found;
    const int bits = sequence_bits(range_of(levels), count);
    for (unsigned code = 0; code < 1u << bits; ++code) {
      std::vector<std::uint8_t> values(static_cast<std::size_t>(count));
      Bits stored;
      stored.put(0, bits, code);
      read_sequence(stored, 0, range_of(levels), values);
      for (const std::uint8_t value : values) EXPECT_LT(value, base);
      found.insert(values);
    }
    EXPECT_EQ(found.size(), static_cast<std::size_t>(std::pow(base, count)));
  }
}

/// Unquantized values run from 0 to the end, each once, near where they would be evenly spaced: multiplying
/// by whole numbers, as the specification does, costs up to 1½.
TEST(AstcSequence, ValuesSpreadEvenly) {
  for (int range = 4; range < kRanges; ++range) {
    const int levels = kRangeTable[static_cast<std::size_t>(range)].levels;
    const auto& table = endpoint_values(range);
    std::vector<int> values(table.begin(), table.begin() + levels);
    std::sort(values.begin(), values.end());
    EXPECT_EQ(std::adjacent_find(values.begin(), values.end()), values.end()) << levels;
    for (int i = 0; i < levels; ++i)
      EXPECT_NEAR(values[static_cast<std::size_t>(i)], 255.0 * i / (levels - 1), 1.5) << levels << " " << i;
  }
  for (int range = 0; range < 12; ++range) {
    const int levels = kRangeTable[static_cast<std::size_t>(range)].levels;
    const auto& table = weight_values(range);
    std::vector<int> values(table.begin(), table.begin() + levels);
    std::sort(values.begin(), values.end());
    EXPECT_EQ(std::adjacent_find(values.begin(), values.end()), values.end()) << levels;
    for (int i = 0; i < levels; ++i)
      EXPECT_NEAR(values[static_cast<std::size_t>(i)], 64.0 * i / (levels - 1), 1.5) << levels << " " << i;
  }
}

/// Every legal block of one plane whose partitions have one mode packs to the same meaning.
TEST(AstcBlock, IsUnpackedAsItWasPacked) {
  std::mt19937 random(2);
  const auto below = [&](int limit) { return static_cast<int>(random() % static_cast<unsigned>(limit)); };
  int packed = 0;
  for (int round = 0; round < 20000; ++round) {
    Block block;
    block.grid_height = 2 + below(3);
    block.weight_range = below(12);
    block.partitions = 1 + below(4);
    block.seed = block.partitions > 1 ? below(kSeeds) : 0;
    std::fill_n(block.modes, block.partitions, below(kEndpointModes));
    const int weight_bits = sequence_bits(block.weight_range, block.weight_count());
    if (weight_bits < 24 || weight_bits > 96 || block.endpoint_count() > 18) continue;
    block.endpoint_range = endpoint_range_of(block);
    if (block.endpoint_range < 0) continue;
    for (int i = 0; i < block.endpoint_count(); ++i)
      block.endpoints[i] = static_cast<std::uint8_t>(
          below(kRangeTable[static_cast<std::size_t>(block.endpoint_range)].levels));
    for (int i = 0; i < block.weight_count(); ++i)
      block.weights[i] =
          static_cast<std::uint8_t>(below(kRangeTable[static_cast<std::size_t>(block.weight_range)].levels));
    Bytes bytes;
    pack(block, bytes.data());
    Block again;
    ASSERT_TRUE(unpack(bytes.data(), again));
    EXPECT_EQ(again.grid_height, block.grid_height);
    EXPECT_EQ(again.weight_range, block.weight_range);
    EXPECT_EQ(again.partitions, block.partitions);
    EXPECT_EQ(again.seed, block.seed);
    EXPECT_EQ(again.modes[block.partitions - 1], block.modes[0]);
    EXPECT_EQ(again.endpoint_range, block.endpoint_range);
    EXPECT_EQ(std::memcmp(again.endpoints, block.endpoints, sizeof block.endpoints), 0);
    EXPECT_EQ(std::memcmp(again.weights, block.weights, sizeof block.weights), 0);
    ++packed;
  }
  EXPECT_GT(packed, 5000);
}

/// The bits of a void extent, by hand.
Bits one_colour(bool hdr, const std::array<unsigned, 4>& corners, const std::array<unsigned, 4>& colour) {
  Bits bits;
  bits.put(0, 9, 0x1fc);
  bits.put(9, 1, hdr ? 1 : 0);
  bits.put(10, 2, 3);
  for (int i = 0; i < 4; ++i) bits.put(12 + 13 * i, 13, corners[static_cast<std::size_t>(i)]);
  for (int c = 0; c < 4; ++c) bits.put(64 + 16 * c, 16, colour[static_cast<std::size_t>(c)]);
  return bits;
}

constexpr std::array<unsigned, 4> kUnbounded = {0x1fff, 0x1fff, 0x1fff, 0x1fff};

TEST(AstcBlock, OneColourIsWhatItStores) {
  const Halves hdr = decoded(one_colour(true, kUnbounded, {0x3c00, 0x7bff, 0x0001, 0xc000}));
  const Halves ldr = decoded(one_colour(false, {0, 100, 5, 6}, {0xffff, 0x8000, 3, 0x1fff}));
  for (std::size_t i = 0; i < hdr.size(); i += 4) {
    EXPECT_EQ(hdr[i], 0x3c00);
    EXPECT_EQ(hdr[i + 1], 0x7bff);
    EXPECT_EQ(hdr[i + 2], 0x0001);
    EXPECT_EQ(hdr[i + 3], 0xc000);
    EXPECT_EQ(ldr[i], kOne);        // 65535: exactly 1
    EXPECT_EQ(ldr[i + 1], 0x3800);  // ½
    EXPECT_EQ(ldr[i + 2], 3 << 8);  // 3·2^-16, a subnormal
    EXPECT_EQ(ldr[i + 3], 0x2fff);  // 0x1fff/65536, cut to eleven bits
  }
}

TEST(AstcBlock, OneColourThatIsNotFiniteIsTheLargest) {
  const Halves halves = decoded(one_colour(true, kUnbounded, {0x7c00, 0xfc00, 0x7e01, 0xffff}));
  EXPECT_EQ(halves[0], 0x7bff);
  EXPECT_EQ(halves[1], 0xfbff);
  EXPECT_EQ(halves[2], 0x7bff);
  EXPECT_EQ(halves[3], 0x7bff);
}

TEST(AstcBlock, VoidExtentsTheWrongWayRoundAreErrors) {
  EXPECT_TRUE(is_error(decoded(one_colour(true, {5, 5, 0, 1}, {0, 0, 0, 0}))));
  EXPECT_TRUE(is_error(decoded(one_colour(true, {0, 1, 9, 3}, {0, 0, 0, 0}))));
  Bits reserved = one_colour(true, kUnbounded, {0, 0, 0, 0});
  reserved.low &= ~(std::uint64_t{1} << 10);
  EXPECT_TRUE(is_error(decoded(reserved)));
}

/// The mode's bits for a grid of 4×`height` or of 2×2, one plane: laid out as the specification's table.
unsigned mode_bits(int height, int range, bool two_planes = false) {
  const auto precision = static_cast<unsigned>(range % 6 + 2);
  return precision >> 1 | (precision & 1) << 4 | static_cast<unsigned>(height - 2) << 5 |
         (range >= 6 ? 1u << 9 : 0) | (two_planes ? 1u << 10 : 0);
}

TEST(AstcBlock, WhatCannotBeIsMagenta) {
  Bits bits;
  EXPECT_TRUE(is_error(decoded(bits)));  // reserved
  bits.put(0, 11, mode_bits(4, 2));
  EXPECT_FALSE(is_error(decoded(bits)));
  Bits wide = bits;
  wide.put(7, 2, 1);  // a grid of five columns
  EXPECT_TRUE(is_error(decoded(wide)));
  Bits few;
  few.put(0, 11, mode_bits(2, 0));  // 8 bits of weights, under 24
  EXPECT_TRUE(is_error(decoded(few)));
  Bits many;
  many.put(0, 11, mode_bits(4, 8, true));  // 128 bits, over 96
  EXPECT_TRUE(is_error(decoded(many)));
  Bits planes;
  planes.put(0, 11, mode_bits(4, 0, true));
  planes.put(11, 2, 3);  // of four partitions
  EXPECT_TRUE(is_error(decoded(planes)));
  Bits endpoints;
  endpoints.put(0, 11, mode_bits(4, 0));
  endpoints.put(11, 2, 2);
  endpoints.put(25, 4, 12);  // three times eight values, over 18
  EXPECT_TRUE(is_error(decoded(endpoints)));
  Bits short_of_bits;
  short_of_bits.put(0, 11, mode_bits(4, 7));  // 58 bits of weights leave 41 for 16 values
  short_of_bits.put(11, 2, 1);
  short_of_bits.put(25, 4, 12);
  EXPECT_TRUE(is_error(decoded(short_of_bits)));
}

TEST(AstcBlock, AnyBitsDecodeToFiniteHalves) {
  std::mt19937_64 random(3);
  for (int round = 0; round < 50000; ++round) {
    Bits bits{random(), random()};
    if (round % 2 == 0) bits.low = (bits.low & ~std::uint64_t{0x18c}) | 1;  // mostly legal
    for (const std::uint16_t half : decoded(bits)) ASSERT_NE(half & 0x7c00, 0x7c00);
  }
}

/// Logarithms rise with their value, from 0 to the largest, and are exact at powers of two.
TEST(AstcBlock, LogarithmsAreMonotonic) {
  for (int value = 1; value < 65536; ++value)
    ASSERT_GE(half_of_logarithm(value), half_of_logarithm(value - 1)) << value;
  for (int exponent = 0; exponent < 31; ++exponent)
    EXPECT_EQ(half_of_logarithm(exponent << 11), exponent << 10);
  EXPECT_EQ(half_of_logarithm(0x7800), kOne);
  EXPECT_EQ(half_of_logarithm(65535), 0x7bff);
}

/// The second region of some of the patterns that BC6H has too, the first texel's partition being the first.
TEST(AstcBlock, PatternsAreTheSpecifications) {
  const auto second = [](int seed) {
    const std::array<std::uint8_t, kTexels> texels = pattern(2, seed);
    unsigned mask = 0;
    for (unsigned i = 0; i < kTexels; ++i) mask |= static_cast<unsigned>(texels[i] != texels[0]) << i;
    return mask;
  };
  EXPECT_EQ(second(28), 0xccccu);  // the right half
  EXPECT_EQ(second(20), 0x8888u);  // the right column
  EXPECT_EQ(second(29), 0xecc8u);
  EXPECT_EQ(second(17), 0xff00u);  // the lower half
  EXPECT_EQ(second(39), 0xf000u);  // the lowest row
}

/// Decodes a pair of endpoints at both ends: weights are 0 for the first texel and the most for the last.
struct Ends {
  std::array<std::uint16_t, 4> first, second;
};
Ends ends_of(int mode, const std::vector<int>& values) {
  Block block;
  block.weight_range = range_of(4);
  block.modes[0] = mode;
  block.endpoint_range = endpoint_range_of(block);
  EXPECT_EQ(kRangeTable[static_cast<std::size_t>(block.endpoint_range)].levels, 256);
  for (std::size_t i = 0; i < values.size(); ++i) block.endpoints[i] = static_cast<std::uint8_t>(values[i]);
  block.weights[kTexels - 1] = 3;
  Bytes bytes;
  pack(block, bytes.data());
  Halves halves;
  decode(bytes.data(), halves.data());
  Ends ends;
  std::copy_n(halves.begin(), 4, ends.first.begin());
  std::copy_n(halves.end() - 4, 4, ends.second.begin());
  return ends;
}

/// UNORM8 as a half: 257 v/65536 towards zero.
std::uint16_t unorm(int v) {
  if (v == 255) return kOne;
  const int wide = 257 * v;
  for (int half = 0x3bff;; --half) {
    const int exponent = half >> 10, mantissa = half & 1023;
    const double value =
        exponent == 0 ? std::ldexp(mantissa, -24) : std::ldexp(1024 + mantissa, exponent - 25);
    if (value <= std::ldexp(wide, -16)) return static_cast<std::uint16_t>(half);
  }
}
std::uint16_t logarithm(int value) {
  return half_of_logarithm(value << 4);
}

using Colour = std::array<std::uint16_t, 4>;

Colour ldr(int r, int g, int b, int a) {
  return {unorm(r), unorm(g), unorm(b), unorm(a)};
}
Colour hdr(int r, int g, int b) {
  return {logarithm(r), logarithm(g), logarithm(b), kOne};
}

TEST(AstcEndpoints, LowDynamicRange) {
  EXPECT_EQ(ends_of(0, {10, 200}).first, ldr(10, 10, 10, 255));
  EXPECT_EQ(ends_of(0, {10, 200}).second, ldr(200, 200, 200, 255));
  // 0x80 and 0x45: 0x20 | 0x40, and 5 more.
  EXPECT_EQ(ends_of(1, {0x80, 0x45}).first, ldr(0x60, 0x60, 0x60, 255));
  EXPECT_EQ(ends_of(1, {0x80, 0x45}).second, ldr(0x65, 0x65, 0x65, 255));
  EXPECT_EQ(ends_of(1, {0xff, 0xff}).second, ldr(255, 255, 255, 255));  // clamped
  EXPECT_EQ(ends_of(4, {1, 2, 3, 4}).first, ldr(1, 1, 1, 3));
  EXPECT_EQ(ends_of(4, {1, 2, 3, 4}).second, ldr(2, 2, 2, 4));
  // An offset of −1 is 0x3f in six bits, a bit up; the base's lowest bit is the offset's highest.
  EXPECT_EQ(ends_of(5, {0x40, 0x7e, 0x40, 0x04}).first, ldr(0x20, 0x20, 0x20, 0x20));
  EXPECT_EQ(ends_of(5, {0x40, 0x7e, 0x40, 0x04}).second, ldr(0x1f, 0x1f, 0x1f, 0x22));
  EXPECT_EQ(ends_of(6, {200, 100, 50, 128}).first, ldr(100, 50, 25, 255));
  EXPECT_EQ(ends_of(6, {200, 100, 50, 128}).second, ldr(200, 100, 50, 255));
  EXPECT_EQ(ends_of(8, {1, 2, 3, 4, 5, 6}).first, ldr(1, 3, 5, 255));
  EXPECT_EQ(ends_of(8, {1, 2, 3, 4, 5, 6}).second, ldr(2, 4, 6, 255));
  // The second darker than the first: swapped, and blue has been taken out.
  EXPECT_EQ(ends_of(8, {100, 20, 80, 10, 60, 30}).first, ldr(25, 20, 30, 255));
  EXPECT_EQ(ends_of(8, {100, 20, 80, 10, 60, 30}).second, ldr(80, 70, 60, 255));
  EXPECT_EQ(ends_of(9, {0x40, 2, 0x40, 4, 0x40, 6}).first, ldr(0x20, 0x20, 0x20, 255));
  EXPECT_EQ(ends_of(9, {0x40, 2, 0x40, 4, 0x40, 6}).second, ldr(0x21, 0x22, 0x23, 255));
  EXPECT_EQ(ends_of(9, {0x40, 0x7e, 0x40, 0x7e, 0x40, 0x7e}).second, ldr(0x20, 0x20, 0x20, 255));
  EXPECT_EQ(ends_of(9, {0x40, 0x7e, 0x40, 0x7e, 0x40, 0x7e}).first, ldr(0x1f, 0x1f, 0x1f, 255));
  EXPECT_EQ(ends_of(10, {200, 100, 50, 128, 7, 9}).first, ldr(100, 50, 25, 7));
  EXPECT_EQ(ends_of(10, {200, 100, 50, 128, 7, 9}).second, ldr(200, 100, 50, 9));
}

TEST(AstcEndpoints, LowDynamicRangeWithAlpha) {
  EXPECT_EQ(ends_of(12, {1, 2, 3, 4, 5, 6, 7, 8}).first, ldr(1, 3, 5, 7));
  EXPECT_EQ(ends_of(12, {1, 2, 3, 4, 5, 6, 7, 8}).second, ldr(2, 4, 6, 8));
  EXPECT_EQ(ends_of(12, {100, 20, 80, 10, 60, 30, 7, 8}).first, ldr(25, 20, 30, 8));
  EXPECT_EQ(ends_of(13, {0x40, 2, 0x40, 4, 0x40, 6, 0x40, 8}).second, ldr(0x21, 0x22, 0x23, 0x24));
}

TEST(AstcEndpoints, HighDynamicRangeOfGrey) {
  EXPECT_EQ(ends_of(2, {0x70, 0x80}).first, hdr(0x700, 0x700, 0x700));
  EXPECT_EQ(ends_of(2, {0x70, 0x80}).second, hdr(0x800, 0x800, 0x800));
  EXPECT_EQ(ends_of(2, {0x80, 0x70}).first, hdr(0x708, 0x708, 0x708));
  EXPECT_EQ(ends_of(2, {0x80, 0x70}).second, hdr(0x7f8, 0x7f8, 0x7f8));
  EXPECT_EQ(ends_of(3, {0x40, 0x73}).first, hdr(0x780, 0x780, 0x780));
  EXPECT_EQ(ends_of(3, {0x40, 0x73}).second, hdr(0x786, 0x786, 0x786));
  EXPECT_EQ(ends_of(3, {0xc0, 0x73}).first, hdr(0x700, 0x700, 0x700));
  EXPECT_EQ(ends_of(3, {0xc0, 0x73}).second, hdr(0x74c, 0x74c, 0x74c));
}

/// Direct values, of which the last two have seven bits, and alpha of both kinds.
TEST(AstcEndpoints, HighDynamicRangeDirect) {
  const std::vector<int> values = {0x70, 0x78, 0x60, 0x80, 0x80 | 0x38, 0x80 | 0x40};
  EXPECT_EQ(ends_of(11, values).first, hdr(0x700, 0x600, 0x700));
  EXPECT_EQ(ends_of(11, values).second, hdr(0x780, 0x800, 0x800));
  std::vector<int> with_alpha = values;
  with_alpha.insert(with_alpha.end(), {0x33, 0x44});
  EXPECT_EQ(ends_of(14, with_alpha).first[3], unorm(0x33));
  EXPECT_EQ(ends_of(14, with_alpha).second[3], unorm(0x44));
  with_alpha[6] = 0x80 | 0x3c;
  with_alpha[7] = 0x80 | 0x3d;
  EXPECT_EQ(ends_of(15, with_alpha).first[3], logarithm(0x3c << 5));
  EXPECT_EQ(ends_of(15, with_alpha).second[3], logarithm(0x3d << 5));
  // Alpha of 8 bits, the highest from the second value, whose other six are an offset: here −1.
  with_alpha[6] = 0x40;
  with_alpha[7] = 0x7f;
  EXPECT_EQ(ends_of(15, with_alpha).first[3], logarithm(0xc00));
  EXPECT_EQ(ends_of(15, with_alpha).second[3], logarithm(0xbf0));
}

}  // namespace
}  // namespace welkin
