#include "welkin/texture/astc_block.h"

#include <algorithm>
#include <bit>
#include <cassert>

#include "welkin/texture/astc_endpoints.h"

namespace welkin::texture::astc {
namespace {

constexpr int kModeBits = 11, kSeedBits = 10, kPartitionsAt = 11, kSinglesModeAt = 13, kSeedAt = 13,
              kModesAt = 23;
constexpr int kMaxEndpoints = 18, kMinWeightBits = 24, kMaxWeightBits = 96;

/// The 11 bits of the block's mode, for grids that 4×4 texels can have.
bool unpack_mode(unsigned mode, Block& block) {
  const auto bits = [&](int at, int count) { return static_cast<int>(mode >> at & ((1u << count) - 1)); };
  // Without these two bits: grids larger than the block, and reserved modes.
  if (bits(0, 2) == 0) return false;
  switch (bits(2, 2)) {
    case 0:
      block.grid_width = bits(7, 2) + 4;
      block.grid_height = bits(5, 2) + 2;
      break;
    case 3:
      block.grid_width = bits(8, 1) != 0 ? bits(7, 1) + 2 : bits(5, 2) + 2;
      block.grid_height = bits(8, 1) != 0 ? bits(5, 2) + 2 : bits(7, 1) + 6;
      break;
    default:  // 8 texels and more in one direction
      return false;
  }
  if (block.grid_width > kSide || block.grid_height > kSide) return false;
  const int precision = bits(0, 2) << 1 | bits(4, 1);
  block.weight_range = precision - 2 + (bits(9, 1) != 0 ? 6 : 0);
  block.two_planes = bits(10, 1) != 0;
  return true;
}

unsigned packed_mode(const Block& block) {
  const int high = block.weight_range >= 6 ? 1 : 0;
  const auto precision = static_cast<unsigned>(block.weight_range - 6 * high + 2);
  assert(block.grid_width == kSide);
  return precision >> 1 | (precision & 1) << 4 | static_cast<unsigned>(block.grid_height - 2) << 5 |
         static_cast<unsigned>(high) << 9 | static_cast<unsigned>(block.two_planes) << 10;
}

bool unpack_one_colour(const Bits& bits, Block& block) {
  constexpr int kCoordinateBits = 13, kCoordinatesAt = 12;
  if (bits.take(10, 2) != 3) return false;
  unsigned corners[4];  // the least and greatest s, the least and greatest t
  for (int i = 0; i < 4; ++i) corners[i] = bits.take(kCoordinatesAt + i * kCoordinateBits, kCoordinateBits);
  const bool unbounded = std::all_of(corners, corners + 4, [](unsigned each) { return each == 0x1fff; });
  if (!unbounded && (corners[0] >= corners[1] || corners[2] >= corners[3])) return false;
  block.one_colour = true;
  block.hdr_colour = bits.take(9, 1) != 0;
  for (int c = 0; c < 4; ++c) block.colour[c] = static_cast<std::uint16_t>(bits.take(64 + 16 * c, 16));
  return true;
}

/// Modes of several partitions, whose last bits lie below `end`; returns the bits that are there.
int unpack_modes(const Bits& bits, int end, Block& block) {
  const unsigned classes = bits.take(kModesAt, 2);
  if (classes == 0) {
    std::fill_n(block.modes, block.partitions, static_cast<int>(bits.take(kModesAt + 2, 4)));
    return 0;
  }
  const int more = 3 * block.partitions - 4;
  const unsigned stream = bits.take(kModesAt + 2, 4) | bits.take(end - more, more) << 4;
  for (int i = 0; i < block.partitions; ++i) {
    const unsigned one_up = stream >> i & 1, in_class = stream >> (block.partitions + 2 * i) & 3;
    block.modes[i] = static_cast<int>(4 * (classes - 1 + one_up) + in_class);
  }
  return more;
}

/// Bits of the block before the endpoints.
int config_bits(const Block& block) {
  return block.partitions == 1 ? 17 : 29;
}

/// The range for endpoints of which `left` bits are left.
int largest_range(int count, int left) {
  if (left < (13 * count + 4) / 5) return -1;
  int range = kRanges - 1;
  while (sequence_bits(range, count) > left) --range;
  return range;
}

std::uint32_t hash(std::uint32_t p) {
  p ^= p >> 15;
  p -= p << 17;
  p += p << 7;
  p += p << 4;
  p ^= p >> 5;
  p += p << 16;
  p ^= p >> 7;
  p ^= p >> 3;
  p ^= p << 6;
  p ^= p >> 17;
  return p;
}

/// The weights of the texels of a plane, 0 … 64, from the grid's.
void infill(const Block& block, int plane, int* weights) {
  const std::array<std::uint8_t, 32>& values = weight_values(block.weight_range);
  const int planes = block.two_planes ? 2 : 1;
  const auto at = [&](int point) {
    const int i = planes * point + plane;
    return static_cast<int>(i < block.weight_count() ? values[block.weights[i]] : 0);
  };
  constexpr int kScale = (1024 + kSide / 2) / (kSide - 1);
  for (int t = 0; t < kSide; ++t) {
    for (int s = 0; s < kSide; ++s) {
      const int gs = (kScale * s * (block.grid_width - 1) + 32) >> 6,
                gt = (kScale * t * (block.grid_height - 1) + 32) >> 6;
      const int fs = gs & 15, ft = gt & 15, first = (gs >> 4) + (gt >> 4) * block.grid_width;
      const int w11 = (fs * ft + 8) >> 4, w10 = ft - w11, w01 = fs - w11, w00 = 16 - fs - ft + w11;
      *weights++ = (at(first) * w00 + at(first + 1) * w01 + at(first + block.grid_width) * w10 +
                    at(first + block.grid_width + 1) * w11 + 8) >>
                   4;
    }
  }
}

/// Of 65535 for 1, rounded towards 0.
std::uint16_t half_of_unorm(int value) {
  if (value == 0xffff) return 0x3c00;
  if (value < 4) return static_cast<std::uint16_t>(value << 8);  // below 2^-14: steps of 2^-24
  const int exponent = static_cast<int>(std::bit_width(static_cast<unsigned>(value))) - 1;
  const int mantissa = (exponent <= 10 ? value << (10 - exponent) : value >> (exponent - 10)) & 0x3ff;
  return static_cast<std::uint16_t>((exponent - 1) << 10 | mantissa);
}

/// A half that is finite: infinity and NaN, of which the specification leaves open what they are, become the
/// largest of their sign, NaN the largest.
std::uint16_t finite(std::uint16_t half) {
  if ((half & 0x7c00) != 0x7c00) return half;
  return half == 0xfc00 ? 0xfbff : 0x7bff;
}

}  // namespace

int Block::endpoint_count() const {
  int count = 0;
  for (int i = 0; i < partitions; ++i) count += values_of_mode(modes[i]);
  return count;
}

bool unpack(const std::byte* bytes, Block& block) {
  constexpr unsigned kVoidExtent = 0x1fc;
  const Bits bits = Bits::load(bytes);
  block = {};
  if (bits.take(0, 9) == kVoidExtent) return unpack_one_colour(bits, block);
  if (!unpack_mode(bits.take(0, kModeBits), block)) return false;
  block.partitions = static_cast<int>(bits.take(kPartitionsAt, 2)) + 1;
  if (block.two_planes && block.partitions == kMaxPartitions) return false;
  const int weight_bits = sequence_bits(block.weight_range, block.weight_count());
  if (weight_bits < kMinWeightBits || weight_bits > kMaxWeightBits) return false;

  int end = 128 - weight_bits;
  if (block.partitions == 1) {
    block.modes[0] = static_cast<int>(bits.take(kSinglesModeAt, 4));
  } else {
    block.seed = static_cast<int>(bits.take(kSeedAt, kSeedBits));
    end -= unpack_modes(bits, end, block);
  }
  if (block.two_planes) {
    end -= 2;
    block.second_channel = static_cast<int>(bits.take(end, 2));
  }
  const int count = block.endpoint_count();
  if (count > kMaxEndpoints) return false;
  block.endpoint_range = largest_range(count, end - config_bits(block));
  if (block.endpoint_range < 0) return false;
  read_sequence(bits, config_bits(block), block.endpoint_range,
                {block.endpoints, static_cast<std::size_t>(count)});
  read_sequence(bits.reversed(), 0, block.weight_range,
                {block.weights, static_cast<std::size_t>(block.weight_count())});
  return true;
}

int endpoint_range_of(const Block& block) {
  const int weight_bits = sequence_bits(block.weight_range, block.weight_count());
  return largest_range(block.endpoint_count(), 128 - weight_bits - config_bits(block));
}

void pack(const Block& block, std::byte* bytes) {
  Bits bits;
  if (block.one_colour) {
    bits.put(0, 9, 0x1fc);
    bits.put(9, 1, block.hdr_colour ? 1 : 0);
    bits.low |= ~std::uint64_t{0} << 10;  // an extent that says nothing about other blocks
    for (int c = 0; c < 4; ++c) bits.put(64 + 16 * c, 16, block.colour[c]);
    return bits.store(bytes);
  }
  assert(!block.two_planes && block.endpoint_range == endpoint_range_of(block));
  Bits weights;
  write_sequence(weights, 0, block.weight_range,
                 {block.weights, static_cast<std::size_t>(block.weight_count())});
  bits = weights.reversed();
  bits.put(0, kModeBits, packed_mode(block));
  bits.put(kPartitionsAt, 2, static_cast<unsigned>(block.partitions - 1));
  if (block.partitions == 1) {
    bits.put(kSinglesModeAt, 4, static_cast<unsigned>(block.modes[0]));
  } else {
    bits.put(kSeedAt, kSeedBits, static_cast<unsigned>(block.seed));
    bits.put(kModesAt + 2, 4, static_cast<unsigned>(block.modes[0]));
  }
  write_sequence(bits, config_bits(block), block.endpoint_range,
                 {block.endpoints, static_cast<std::size_t>(block.endpoint_count())});
  bits.store(bytes);
}

std::array<std::uint8_t, kTexels> pattern(int partitions, int seed) {
  std::array<std::uint8_t, kTexels> texels{};
  if (partitions == 1) return texels;
  const std::uint32_t full_seed = static_cast<std::uint32_t>(seed + (partitions - 1) * kSeeds),
                      random = hash(full_seed);
  constexpr int kShifts[12] = {0, 4, 8, 12, 16, 20, 24, 28, 18, 22, 26, 30};
  const int by_count = partitions == 3 ? 6 : 5, by_seed = (full_seed & 2) != 0 ? 4 : 5;
  const bool odd = (full_seed & 1) != 0;
  const int shifts[2] = {odd ? by_seed : by_count, odd ? by_count : by_seed};
  int seeds[8];
  for (int i = 0; i < 8; ++i) {
    const int nibble = static_cast<int>(random >> kShifts[i] & 15);
    seeds[i] = nibble * nibble >> shifts[i % 2];
  }
  const int offsets[4] = {static_cast<int>(random >> 14 & 63), static_cast<int>(random >> 10 & 63),
                          static_cast<int>(random >> 6 & 63), static_cast<int>(random >> 2 & 63)};
  for (int i = 0; i < kTexels; ++i) {
    // Coordinates of blocks of fewer than 31 texels are doubled.
    const int x = 2 * (i % kSide), y = 2 * (i / kSide);
    int best = 0, most = -1;
    for (int p = 0; p < partitions; ++p) {
      const int value = (seeds[2 * p] * x + seeds[2 * p + 1] * y + offsets[p]) & 63;
      if (value > most) {
        most = value;
        best = p;
      }
    }
    texels[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(best);
  }
  return texels;
}

void decode(const std::byte* bytes, std::uint16_t* halves) {
  constexpr std::uint16_t kOne = 0x3c00, kMagenta[4] = {kOne, 0, kOne, kOne};
  Block block;
  const bool legal = unpack(bytes, block);
  if (!legal || block.one_colour) {
    for (int i = 0; i < 4 * kTexels; ++i) {
      const std::uint16_t value = block.colour[i % 4];
      *halves++ = !legal ? kMagenta[i % 4] : block.hdr_colour ? finite(value) : half_of_unorm(value);
    }
    return;
  }
  std::uint8_t values[kMaxEndpoints];
  const std::array<std::uint8_t, 256>& meaning = endpoint_values(block.endpoint_range);
  for (int i = 0; i < block.endpoint_count(); ++i) values[i] = meaning[block.endpoints[i]];
  Endpoints ends[kMaxPartitions];
  const std::uint8_t* from = values;
  for (int p = 0; p < block.partitions; ++p) {
    ends[p] = endpoints_of(block.modes[p], from);
    from += values_of_mode(block.modes[p]);
  }
  int weights[2][kTexels];
  infill(block, 0, weights[0]);
  if (block.two_planes) infill(block, 1, weights[1]);
  const std::array<std::uint8_t, kTexels> partition = pattern(block.partitions, block.seed);
  for (int i = 0; i < kTexels; ++i) {
    const Endpoints& pair = ends[partition[static_cast<std::size_t>(i)]];
    for (int c = 0; c < 4; ++c) {
      const int w = weights[block.two_planes && c == block.second_channel ? 1 : 0][i];
      const int value = (pair.colour[0][c] * (64 - w) + pair.colour[1][c] * w + 32) >> 6;
      *halves++ = (c == 3 ? pair.hdr_alpha : pair.hdr) ? half_of_logarithm(value) : half_of_unorm(value);
    }
  }
}

}  // namespace welkin::texture::astc
