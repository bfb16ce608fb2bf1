#include "welkin/texture/bc6h_block.h"

#include <algorithm>
#include <string_view>
#include <vector>

namespace welkin::texture::bc6h {

const std::array<Mode, kModes> kModeTable = {{{0x00, 2, 2, true, 10, {5, 5, 5}},
                                              {0x01, 2, 2, true, 7, {6, 6, 6}},
                                              {0x02, 5, 2, true, 11, {5, 4, 4}},
                                              {0x06, 5, 2, true, 11, {4, 5, 4}},
                                              {0x0a, 5, 2, true, 11, {4, 4, 5}},
                                              {0x0e, 5, 2, true, 9, {5, 5, 5}},
                                              {0x12, 5, 2, true, 8, {6, 5, 5}},
                                              {0x16, 5, 2, true, 8, {5, 6, 5}},
                                              {0x1a, 5, 2, true, 8, {5, 5, 6}},
                                              {0x1e, 5, 2, false, 6, {6, 6, 6}},
                                              {0x03, 5, 1, false, 10, {10, 10, 10}},
                                              {0x07, 5, 1, true, 11, {9, 9, 9}},
                                              {0x0b, 5, 1, true, 12, {8, 8, 8}},
                                              {0x0f, 5, 1, true, 16, {4, 4, 4}}}};

const std::array<Partition, kPartitions> kPartitionTable = {
    {{0xcccc, 15}, {0x8888, 15}, {0xeeee, 15}, {0xecc8, 15}, {0xc880, 15}, {0xfeec, 15}, {0xfec8, 15},
     {0xec80, 15}, {0xc800, 15}, {0xffec, 15}, {0xfe80, 15}, {0xe800, 15}, {0xffe8, 15}, {0xff00, 15},
     {0xfff0, 15}, {0xf000, 15}, {0xf710, 15}, {0x008e, 2},  {0x7100, 8},  {0x08ce, 2},  {0x008c, 2},
     {0x7310, 8},  {0x3100, 8},  {0x8cce, 15}, {0x088c, 2},  {0x3110, 8},  {0x6666, 2},  {0x366c, 2},
     {0x17e8, 8},  {0x0ff0, 8},  {0x718e, 2},  {0x399c, 2}}};

namespace {

/// Where the bits between the mode's code and the partition go, as the specifications write it: r, g, b; w
/// and x for A and B of the first region, y and z of the second; the first bit of the field, and the last.
constexpr std::string_view kLayouts[kModes] = {
    "gy4 by4 bz4 rw0-9 gw0-9 bw0-9 rx0-4 gz4 gy0-3 gx0-4 bz0 gz0-3 bx0-4 bz1 by0-3 ry0-4 bz2 rz0-4 bz3",
    "gy5 gz4-5 rw0-6 bz0-1 by4 gw0-6 by5 bz2 gy4 bw0-6 bz3 bz5-4 rx0-5 gy0-3 gx0-5 gz0-3 bx0-5 by0-3 ry0-5 "
    "rz0-5",
    "rw0-9 gw0-9 bw0-9 rx0-4 rw10 gy0-3 gx0-3 gw10 bz0 gz0-3 bx0-3 bw10 bz1 by0-3 ry0-4 bz2 rz0-4 bz3",
    "rw0-9 gw0-9 bw0-9 rx0-3 rw10 gz4 gy0-3 gx0-4 gw10 gz0-3 bx0-3 bw10 bz1 by0-3 ry0-3 bz0 bz2 rz0-3 gy4 "
    "bz3",
    "rw0-9 gw0-9 bw0-9 rx0-3 rw10 by4 gy0-3 gx0-3 gw10 bz0 gz0-3 bx0-4 bw10 by0-3 ry0-3 bz1-2 rz0-3 bz4-3",
    "rw0-8 by4 gw0-8 gy4 bw0-8 bz4 rx0-4 gz4 gy0-3 gx0-4 bz0 gz0-3 bx0-4 bz1 by0-3 ry0-4 bz2 rz0-4 bz3",
    "rw0-7 gz4 by4 gw0-7 bz2 gy4 bw0-7 bz3-4 rx0-5 gy0-3 gx0-4 bz0 gz0-3 bx0-4 bz1 by0-3 ry0-5 rz0-5",
    "rw0-7 bz0 by4 gw0-7 gy5-4 bw0-7 gz5 bz4 rx0-4 gz4 gy0-3 gx0-5 gz0-3 bx0-4 bz1 by0-3 ry0-4 bz2 rz0-4 bz3",
    "rw0-7 bz1 by4 gw0-7 by5 gy4 bw0-7 bz5-4 rx0-4 gz4 gy0-3 gx0-4 bz0 gz0-3 bx0-5 by0-3 ry0-4 bz2 rz0-4 bz3",
    "rw0-5 gz4 bz0-1 by4 gw0-5 gy5 by5 bz2 gy4 bw0-5 gz5 bz3 bz5-4 rx0-5 gy0-3 gx0-5 gz0-3 bx0-5 by0-3 ry0-5 "
    "rz0-5",
    "rw0-9 gw0-9 bw0-9 rx0-9 gx0-9 bx0-9",
    "rw0-9 gw0-9 bw0-9 rx0-8 rw10 gx0-8 gw10 bx0-8 bw10",
    "rw0-9 gw0-9 bw0-9 rx0-7 rw11-10 gx0-7 gw11-10 bx0-7 bw11-10",
    "rw0-9 gw0-9 bw0-9 rx0-3 rw15-10 gx0-3 gw15-10 bx0-3 bw15-10"};

/// A bit of the block: of which endpoint's which channel.
struct Bit {
  std::uint8_t endpoint, channel, bit;
};

std::vector<Bit> parsed(std::string_view layout) {
  std::vector<Bit> bits;
  while (!layout.empty()) {
    const std::string_view field = layout.substr(0, layout.find(' '));
    layout.remove_prefix(std::min(layout.size(), field.size() + 1));
    const auto number = [](std::string_view digits) {
      int value = 0;
      for (const char digit : digits) value = value * 10 + (digit - '0');
      return value;
    };
    const std::size_t dash = field.find('-');
    const int first = number(field.substr(2, dash == std::string_view::npos ? dash : dash - 2));
    const int last = dash == std::string_view::npos ? first : number(field.substr(dash + 1));
    for (int bit = first;; bit += last > first ? 1 : -1) {
      bits.push_back({static_cast<std::uint8_t>(field[1] - 'w'),
                      static_cast<std::uint8_t>(field[0] == 'r'   ? 0
                                                : field[0] == 'g' ? 1
                                                                  : 2),
                      static_cast<std::uint8_t>(bit)});
      if (bit == last) break;
    }
  }
  return bits;
}

const std::array<std::vector<Bit>, kModes>& layouts() {
  static const std::array<std::vector<Bit>, kModes> all = [] {
    std::array<std::vector<Bit>, kModes> parsed_layouts;
    for (std::size_t mode = 0; mode < kModes; ++mode) parsed_layouts[mode] = parsed(kLayouts[mode]);
    return parsed_layouts;
  }();
  return all;
}

/// The block's bits from the lowest of the first byte on.
class BitReader {
 public:
  explicit BitReader(const std::byte* bytes) : bytes_(bytes) {}
  int take(int count) {
    int value = 0;
    for (int i = 0; i < count; ++i, ++at_)
      value |= static_cast<int>(std::to_integer<unsigned>(bytes_[at_ / 8]) >> (at_ % 8) & 1) << i;
    return value;
  }

 private:
  const std::byte* bytes_;
  std::size_t at_ = 0;
};

class BitWriter {
 public:
  void put(int value, int count) {
    const auto bits = static_cast<std::uint64_t>(value) & ((std::uint64_t{1} << count) - 1);
    if (at_ < 64) {
      low_ |= bits << at_;
      if (at_ + count > 64) high_ |= bits >> (64 - at_);
    } else {
      high_ |= bits << (at_ - 64);
    }
    at_ += count;
  }
  void store(std::byte* bytes) const {
    for (int i = 0; i < 8; ++i) bytes[i] = static_cast<std::byte>(low_ >> (8 * i) & 255);
    for (int i = 0; i < 8; ++i) bytes[8 + i] = static_cast<std::byte>(high_ >> (8 * i) & 255);
  }

 private:
  std::uint64_t low_ = 0, high_ = 0;
  int at_ = 0;
};

int sign_extended(int value, int bits) {
  return (value & 1 << (bits - 1)) != 0 ? value - (1 << bits) : value;
}

bool is_anchor(const Mode& mode, int partition, int texel) {
  return texel == 0 ||
         (mode.regions == 2 && texel == kPartitionTable[static_cast<std::size_t>(partition)].anchor);
}

int unquantized_signed(int value, int precision) {
  if (precision >= 16 || value == 0) return value;
  const int magnitude = value < 0 ? -value : value;
  const int wide =
      magnitude >= (1 << (precision - 1)) - 1 ? 0x7fff : ((magnitude << 15) + 0x4000) >> (precision - 1);
  return value < 0 ? -wide : wide;
}

std::uint16_t signed_half(int value) {
  const int magnitude = ((value < 0 ? -value : value) * 31) >> 5;
  return static_cast<std::uint16_t>(value < 0 && magnitude > 0 ? 0x8000 | magnitude : magnitude);
}

}  // namespace

bool fits(const Block& block, int channel) {
  const Mode& mode = kModeTable[static_cast<std::size_t>(block.mode)];
  if (!mode.differences) return true;
  const int half = 1 << (mode.other_bits[channel] - 1);
  for (int e = 1; e < 2 * mode.regions; ++e) {
    const int difference = block.endpoints[e][channel] - block.endpoints[0][channel];
    if (difference < -half || difference >= half) return false;
  }
  return true;
}

bool fits(const Block& block) {
  return fits(block, 0) && fits(block, 1) && fits(block, 2);
}

void pack(const Block& block, std::byte* bytes) {
  const Mode& mode = kModeTable[static_cast<std::size_t>(block.mode)];
  BitWriter writer;
  writer.put(mode.code, mode.code_bits);
  for (const Bit& bit : layouts()[static_cast<std::size_t>(block.mode)]) {
    int value = block.endpoints[bit.endpoint][bit.channel];
    if (mode.differences && bit.endpoint > 0) value -= block.endpoints[0][bit.channel];
    writer.put(value >> bit.bit & 1, 1);
  }
  if (mode.regions == 2) writer.put(block.partition, 5);
  for (int i = 0; i < kTexels; ++i)
    writer.put(block.indices[i], mode.index_bits() - (is_anchor(mode, block.partition, i) ? 1 : 0));
  writer.store(bytes);
}

bool unpack(const std::byte* bytes, bool is_signed, Block& block) {
  BitReader reader(bytes);
  int code = reader.take(2);
  if (code >= 2) code |= reader.take(3) << 2;
  const auto found =
      std::find_if(kModeTable.begin(), kModeTable.end(), [&](const Mode& mode) { return mode.code == code; });
  if (found == kModeTable.end()) return false;
  const Mode& mode = *found;
  block = {};
  block.mode = static_cast<int>(found - kModeTable.begin());
  for (const Bit& bit : layouts()[static_cast<std::size_t>(block.mode)])
    block.endpoints[bit.endpoint][bit.channel] |= reader.take(1) << bit.bit;
  if (mode.regions == 2) block.partition = reader.take(5);
  for (int e = 0; e < 2 * mode.regions; ++e) {
    for (int c = 0; c < 3; ++c) {
      int& value = block.endpoints[e][c];
      if (e > 0 && mode.differences) {
        value =
            (block.endpoints[0][c] + sign_extended(value, mode.other_bits[c])) & ((1 << mode.precision) - 1);
        if (is_signed) value = sign_extended(value, mode.precision);
      } else if (is_signed) {
        value = sign_extended(value, mode.precision);
      }
    }
  }
  for (int i = 0; i < kTexels; ++i) {
    block.indices[i] = static_cast<std::uint8_t>(
        reader.take(mode.index_bits() - (is_anchor(mode, block.partition, i) ? 1 : 0)));
  }
  return true;
}

void decode(const std::byte* bytes, bool is_signed, std::uint16_t* halves) {
  Block block;
  if (!unpack(bytes, is_signed, block)) {
    std::fill_n(halves, 3 * kTexels, std::uint16_t{0});
    return;
  }
  const Mode& mode = kModeTable[static_cast<std::size_t>(block.mode)];
  int wide[4][3];
  for (int e = 0; e < 2 * mode.regions; ++e) {
    for (int c = 0; c < 3; ++c) {
      wide[e][c] = is_signed ? unquantized_signed(block.endpoints[e][c], mode.precision)
                             : unquantized(block.endpoints[e][c], mode.precision);
    }
  }
  const int* weights = mode.regions == 1 ? kWeights4 : kWeights3;
  const unsigned second =
      mode.regions == 1 ? 0u : kPartitionTable[static_cast<std::size_t>(block.partition)].second;
  for (unsigned i = 0; i < kTexels; ++i) {
    const int a = 2 * static_cast<int>(second >> i & 1), w = weights[block.indices[i]];
    for (int c = 0; c < 3; ++c) {
      *halves++ = is_signed ? signed_half((wide[a][c] * (64 - w) + wide[a + 1][c] * w + 32) >> 6)
                            : static_cast<std::uint16_t>(interpolated(wide[a][c], wide[a + 1][c], w));
    }
  }
}

}  // namespace welkin::texture::bc6h
