#include "welkin/texture/astc_sequence.h"

#include <algorithm>
#include <cassert>

namespace welkin::texture::astc {

const std::array<Range, kRanges> kRangeTable = {
    {{2, 0, 0, 1},   {3, 1, 0, 0},   {4, 0, 0, 2},  {5, 0, 1, 0},  {6, 1, 0, 1},  {8, 0, 0, 3},
     {10, 0, 1, 1},  {12, 1, 0, 2},  {16, 0, 0, 4}, {20, 0, 1, 2}, {24, 1, 0, 3}, {32, 0, 0, 5},
     {40, 0, 1, 3},  {48, 1, 0, 4},  {64, 0, 0, 6}, {80, 0, 1, 4}, {96, 1, 0, 5}, {128, 0, 0, 7},
     {160, 0, 1, 5}, {192, 1, 0, 6}, {256, 0, 0, 8}}};

namespace {

/// Bits of the packed trits or quints behind the low bits of each value.
constexpr int kTritBits[5] = {2, 2, 1, 2, 1}, kQuintBits[3] = {3, 2, 2};

unsigned field(unsigned value, int high, int low) {
  return value >> low & ((2u << (high - low)) - 1);
}
unsigned bit(unsigned value, int at) {
  return value >> at & 1;
}

using Digits = std::array<std::uint8_t, 5>;

/// The specification's procedure for 8 bits.
Digits trits_of(unsigned t) {
  unsigned c, t0, t1, t2, t3, t4;
  if (field(t, 4, 2) == 7) {
    c = field(t, 7, 5) << 2 | field(t, 1, 0);
    t4 = t3 = 2;
  } else {
    c = field(t, 4, 0);
    if (field(t, 6, 5) == 3) {
      t4 = 2;
      t3 = bit(t, 7);
    } else {
      t4 = bit(t, 7);
      t3 = field(t, 6, 5);
    }
  }
  if (field(c, 1, 0) == 3) {
    t2 = 2;
    t1 = bit(c, 4);
    t0 = bit(c, 3) << 1 | (bit(c, 2) & ~bit(c, 3));
  } else if (field(c, 3, 2) == 3) {
    t2 = t1 = 2;
    t0 = field(c, 1, 0);
  } else {
    t2 = bit(c, 4);
    t1 = field(c, 3, 2);
    t0 = bit(c, 1) << 1 | (bit(c, 0) & ~bit(c, 1));
  }
  return {static_cast<std::uint8_t>(t0), static_cast<std::uint8_t>(t1), static_cast<std::uint8_t>(t2),
          static_cast<std::uint8_t>(t3), static_cast<std::uint8_t>(t4)};
}

/// And for 7.
Digits quints_of(unsigned q) {
  unsigned q0, q1, q2;
  if (field(q, 2, 1) == 3 && field(q, 6, 5) == 0) {
    const unsigned none = ~bit(q, 0) & 1;
    q2 = bit(q, 0) << 2 | (bit(q, 4) & none) << 1 | (bit(q, 3) & none);
    q1 = q0 = 4;
  } else {
    unsigned c;
    if (field(q, 2, 1) == 3) {
      q2 = 4;
      c = field(q, 4, 3) << 3 | (~field(q, 6, 5) & 3) << 1 | bit(q, 0);
    } else {
      q2 = field(q, 6, 5);
      c = field(q, 4, 0);
    }
    if (field(c, 2, 0) == 5) {
      q1 = 4;
      q0 = field(c, 4, 3);
    } else {
      q1 = field(c, 4, 3);
      q0 = field(c, 2, 0);
    }
  }
  return {static_cast<std::uint8_t>(q0), static_cast<std::uint8_t>(q1), static_cast<std::uint8_t>(q2), 0, 0};
}

/// Both directions. Of several codes for the same digits the lowest is written.
struct DigitTables {
  std::array<Digits, 256> trits;
  std::array<Digits, 128> quints;
  std::array<std::uint8_t, 243> code_of_trits;
  std::array<std::uint8_t, 125> code_of_quints;

  static const DigitTables& get() {
    static const DigitTables tables = [] {
      DigitTables made;
      for (unsigned code = 256; code-- > 0;) {
        const Digits& d = made.trits[code] = trits_of(code);
        made.code_of_trits[number(d, 5, 3)] = static_cast<std::uint8_t>(code);
      }
      for (unsigned code = 128; code-- > 0;) {
        const Digits& d = made.quints[code] = quints_of(code);
        made.code_of_quints[number(d, 3, 5)] = static_cast<std::uint8_t>(code);
      }
      return made;
    }();
    return tables;
  }

  static std::size_t number(const Digits& digits, int count, unsigned base) {
    std::size_t value = 0;
    for (int i = count; i-- > 0;) value = value * base + digits[static_cast<std::size_t>(i)];
    return value;
  }
};

/// How a range's values lie: in groups of `group`, each value's low bits before some bits of the code.
struct Layout {
  int group, low_bits;
  const int* code_bits;  ///< null when there is no code

  explicit Layout(const Range& range)
      : group(range.trits != 0    ? 5
              : range.quints != 0 ? 3
                                  : 1),
        low_bits(range.bits),
        code_bits(range.trits != 0    ? kTritBits
                  : range.quints != 0 ? kQuintBits
                                      : nullptr) {}
};

/// The bits of `value` from the highest on repeated to `width`.
unsigned repeated(unsigned value, int bits, int width) {
  unsigned out = 0;
  for (int at = width; at > 0; at -= bits) out |= at >= bits ? value << (at - bits) : value >> (bits - at);
  return out;
}

/// C of the specification's tables for a trit or quint above 1, 2, … low bits.
constexpr unsigned kEndpointTrit[7] = {0, 204, 93, 44, 22, 11, 5},
                   kEndpointQuint[6] = {0, 113, 54, 26, 13, 6}, kWeightTrit[4] = {0, 50, 23, 11},
                   kWeightQuint[3] = {0, 28, 13};

/// B of the tables: where the low bits but the lowest go, of 9 bits for endpoints.
unsigned endpoint_b(const Range& range, unsigned low) {
  const unsigned above = low >> 1;  // the bits b, c, d, e, f
  const int n = range.bits - 1;
  if (n == 0) return 0;
  if (range.trits != 0) {
    switch (n) {
      case 1:
        return above * 0b100010110;
      case 2:
        return above << 7 | above << 2 | above;
      case 3:
        return above << 6 | above;
      case 4:
        return above << 5 | above >> 2;
      default:
        return above << 4 | above >> 4;
    }
  }
  switch (n) {
    case 1:
      return above * 0b100001100;
    case 2:
      return above << 7 | above << 1 | above >> 1;
    case 3:
      return above << 6 | above >> 1;
    default:
      return above << 5 | above >> 3;
  }
}

std::array<std::uint8_t, 256> made_endpoint_values(const Range& range) {
  std::array<std::uint8_t, 256> values{};
  for (unsigned v = 0; v < static_cast<unsigned>(range.levels); ++v) {
    if (range.trits == 0 && range.quints == 0) {
      values[v] = static_cast<std::uint8_t>(repeated(v, range.bits, 8));
      continue;
    }
    if (range.bits == 0) continue;  // fewer than six levels: not of endpoints
    const unsigned low = v & ((1u << range.bits) - 1), digit = v >> range.bits;
    const unsigned a = (low & 1) != 0 ? 0x1ff : 0;
    const unsigned c = range.trits != 0 ? kEndpointTrit[range.bits] : kEndpointQuint[range.bits];
    const unsigned t = (digit * c + endpoint_b(range, low)) ^ a;
    values[v] = static_cast<std::uint8_t>((a & 0x80) | t >> 2);
  }
  return values;
}

std::array<std::uint8_t, 32> made_weight_values(const Range& range) {
  constexpr unsigned kThree[3] = {0, 32, 63}, kFive[5] = {0, 16, 32, 47, 63};
  std::array<std::uint8_t, 32> values{};
  for (unsigned v = 0; v < static_cast<unsigned>(range.levels); ++v) {
    unsigned w;
    if (range.trits == 0 && range.quints == 0) {
      w = repeated(v, range.bits, 6);
    } else if (range.bits == 0) {
      w = range.trits != 0 ? kThree[v] : kFive[v];
    } else {
      const unsigned low = v & ((1u << range.bits) - 1), digit = v >> range.bits, above = low >> 1;
      const unsigned a = (low & 1) != 0 ? 0x7f : 0;
      unsigned b = 0;
      if (range.trits != 0 && range.bits == 2) b = above * 0b1000101;
      if (range.trits != 0 && range.bits == 3) b = above << 5 | above;
      if (range.quints != 0 && range.bits == 2) b = above * 0b1000010;
      const unsigned c = range.trits != 0 ? kWeightTrit[range.bits] : kWeightQuint[range.bits];
      const unsigned t = (digit * c + b) ^ a;
      w = (a & 0x20) | t >> 2;
    }
    values[v] = static_cast<std::uint8_t>(w > 32 ? w + 1 : w);
  }
  return values;
}

}  // namespace

unsigned Bits::take(int at, int count) const {
  if (count == 0 || at >= 128) return 0;
  std::uint64_t value = at >= 64 ? high >> (at - 64) : low >> at;
  if (at > 0 && at < 64) value |= high << (64 - at);
  return static_cast<unsigned>(value & ((std::uint64_t{1} << count) - 1));
}

void Bits::put(int at, int count, unsigned value) {
  assert(at + count <= 128);
  const std::uint64_t bits = value & ((std::uint64_t{1} << count) - 1);
  if (at >= 64) {
    high |= bits << (at - 64);
  } else {
    low |= bits << at;
    if (at + count > 64) high |= bits >> (64 - at);
  }
}

Bits Bits::reversed() const {
  const auto reverse = [](std::uint64_t value) {
    value = (value & 0x5555555555555555u) << 1 | (value >> 1 & 0x5555555555555555u);
    value = (value & 0x3333333333333333u) << 2 | (value >> 2 & 0x3333333333333333u);
    value = (value & 0x0f0f0f0f0f0f0f0fu) << 4 | (value >> 4 & 0x0f0f0f0f0f0f0f0fu);
    value = (value & 0x00ff00ff00ff00ffu) << 8 | (value >> 8 & 0x00ff00ff00ff00ffu);
    value = (value & 0x0000ffff0000ffffu) << 16 | (value >> 16 & 0x0000ffff0000ffffu);
    return value << 32 | value >> 32;
  };
  return {reverse(high), reverse(low)};
}

Bits Bits::load(const std::byte* bytes) {
  Bits bits;
  for (int i = 0; i < 8; ++i) {
    bits.low |= std::to_integer<std::uint64_t>(bytes[i]) << (8 * i);
    bits.high |= std::to_integer<std::uint64_t>(bytes[8 + i]) << (8 * i);
  }
  return bits;
}

void Bits::store(std::byte* bytes) const {
  for (int i = 0; i < 8; ++i) {
    bytes[i] = static_cast<std::byte>(low >> (8 * i) & 255);
    bytes[8 + i] = static_cast<std::byte>(high >> (8 * i) & 255);
  }
}

int range_of(int levels) {
  const auto found = std::find_if(kRangeTable.begin(), kRangeTable.end(),
                                  [&](const Range& range) { return range.levels == levels; });
  assert(found != kRangeTable.end());
  return static_cast<int>(found - kRangeTable.begin());
}

int sequence_bits(int range, int count) {
  const Range& r = kRangeTable[static_cast<std::size_t>(range)];
  return (8 * r.trits * count + 4) / 5 + (7 * r.quints * count + 2) / 3 + r.bits * count;
}

void read_sequence(const Bits& bits, int at, int range, std::span<std::uint8_t> values) {
  const Layout layout(kRangeTable[static_cast<std::size_t>(range)]);
  const DigitTables& tables = DigitTables::get();
  const auto group = static_cast<std::size_t>(layout.group);
  for (std::size_t first = 0; first < values.size(); first += group) {
    unsigned lows[5] = {}, code = 0;
    const std::size_t count = std::min(group, values.size() - first);
    for (std::size_t i = 0, code_at = 0; i < count; ++i) {
      lows[i] = bits.take(at, layout.low_bits);
      at += layout.low_bits;
      if (layout.code_bits == nullptr) continue;
      code |= bits.take(at, layout.code_bits[i]) << code_at;
      at += layout.code_bits[i];
      code_at += static_cast<std::size_t>(layout.code_bits[i]);
    }
    const Digits digits = group == 5 ? tables.trits[code] : group == 3 ? tables.quints[code] : Digits{};
    for (std::size_t i = 0; i < count; ++i)
      values[first + i] =
          static_cast<std::uint8_t>(static_cast<unsigned>(digits[i]) << layout.low_bits | lows[i]);
  }
}

void write_sequence(Bits& bits, int at, int range, std::span<const std::uint8_t> values) {
  const Layout layout(kRangeTable[static_cast<std::size_t>(range)]);
  const DigitTables& tables = DigitTables::get();
  const auto group = static_cast<std::size_t>(layout.group);
  for (std::size_t first = 0; first < values.size(); first += group) {
    Digits digits{};
    const std::size_t count = std::min(group, values.size() - first);
    for (std::size_t i = 0; i < count; ++i)
      digits[i] = static_cast<std::uint8_t>(values[first + i] >> layout.low_bits);
    unsigned code = 0;
    if (group == 5) code = tables.code_of_trits[DigitTables::number(digits, 5, 3)];
    if (group == 3) code = tables.code_of_quints[DigitTables::number(digits, 3, 5)];
    for (std::size_t i = 0; i < count; ++i) {
      bits.put(at, layout.low_bits, values[first + i]);
      at += layout.low_bits;
      if (layout.code_bits == nullptr) continue;
      bits.put(at, layout.code_bits[i], code);
      at += layout.code_bits[i];
      code >>= layout.code_bits[i];
    }
  }
}

const std::array<std::uint8_t, 256>& endpoint_values(int range) {
  static const auto tables = [] {
    std::array<std::array<std::uint8_t, 256>, kRanges> made;
    for (std::size_t i = 0; i < kRanges; ++i) made[i] = made_endpoint_values(kRangeTable[i]);
    return made;
  }();
  return tables[static_cast<std::size_t>(range)];
}

const std::array<std::uint8_t, 32>& weight_values(int range) {
  static const auto tables = [] {
    std::array<std::array<std::uint8_t, 32>, 12> made;
    for (std::size_t i = 0; i < made.size(); ++i) made[i] = made_weight_values(kRangeTable[i]);
    return made;
  }();
  return tables[static_cast<std::size_t>(range)];
}

}  // namespace welkin::texture::astc
