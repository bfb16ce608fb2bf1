#include "welkin/texture/uastc_endpoints.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "welkin/texture/astc_endpoints.h"
#include "welkin/texture/astc_sequence.h"

namespace welkin::texture::uastc {
namespace {

/// A bit of a field that is stored beside another field's bits.
struct Extra {
  int field, bit;
};

/// Of mode 11, by layout: the extra bits X0 … X5 of the specification's table. Fields: a, c, b0, b1, d0, d1.
enum DirectField { kA, kC, kB0, kB1, kD0, kD1 };
constexpr Extra kDirectExtras[8][6] = {{{kB0, 6}, {kB1, 6}, {kD0, 6}, {kD1, 6}, {kD0, 5}, {kD1, 5}},
                                       {{kB0, 6}, {kB1, 6}, {kB0, 7}, {kB1, 7}, {kD0, 5}, {kD1, 5}},
                                       {{kA, 9}, {kC, 6}, {kD0, 6}, {kD1, 6}, {kD0, 5}, {kD1, 5}},
                                       {{kB0, 6}, {kB1, 6}, {kA, 9}, {kC, 6}, {kD0, 5}, {kD1, 5}},
                                       {{kB0, 6}, {kB1, 6}, {kB0, 7}, {kB1, 7}, {kA, 9}, {kA, 10}},
                                       {{kA, 9}, {kA, 10}, {kC, 7}, {kC, 6}, {kD0, 5}, {kD1, 5}},
                                       {{kB0, 6}, {kB1, 6}, {kA, 11}, {kC, 6}, {kA, 9}, {kA, 10}},
                                       {{kA, 9}, {kA, 10}, {kA, 11}, {kC, 6}, {kD0, 5}, {kD1, 5}}};

/// Of mode 7: X0 … X6. Fields: the largest channel, both others, the scale.
enum ScaleField { kR, kG, kB, kS };
constexpr Extra kScaleExtras[6][7] = {{{kR, 9}, {kR, 8}, {kR, 7}, {kR, 10}, {kR, 6}, {kS, 6}, {kS, 5}},
                                      {{kR, 8}, {kG, 5}, {kR, 7}, {kB, 5}, {kR, 6}, {kR, 10}, {kR, 9}},
                                      {{kR, 9}, {kR, 8}, {kR, 7}, {kR, 6}, {kS, 7}, {kS, 6}, {kS, 5}},
                                      {{kR, 8}, {kG, 5}, {kR, 7}, {kB, 5}, {kR, 6}, {kS, 6}, {kS, 5}},
                                      {{kG, 6}, {kG, 5}, {kB, 6}, {kB, 5}, {kR, 6}, {kR, 7}, {kS, 5}},
                                      {{kG, 6}, {kG, 5}, {kB, 6}, {kB, 5}, {kR, 6}, {kS, 6}, {kS, 5}}};

int rounded(float value, int lowest, int highest) {
  return static_cast<int>(
      std::floor(std::clamp(value, static_cast<float>(lowest), static_cast<float>(highest)) + 0.5f));
}

/// Stores a field's low bits beside `high`, as near as the range allows, and returns the byte; the field
/// becomes what that says.
std::uint8_t stored(int& field, unsigned high, int low_bits, const StoredValues& range) {
  const unsigned mask = (1u << low_bits) - 1;
  const std::uint8_t byte =
      range.nearest[static_cast<std::size_t>(8 - low_bits)][high | (static_cast<unsigned>(field) & mask)];
  field = static_cast<int>((static_cast<unsigned>(field) & ~mask) | (byte & mask));
  return byte;
}

int largest_of(const float* colour) {
  return colour[0] >= colour[1] && colour[0] >= colour[2] ? 0 : colour[1] >= colour[2] ? 1 : 2;
}

StoredValues made_of(int range) {
  StoredValues made{};
  const auto& values = astc::endpoint_values(range);
  const auto levels = static_cast<std::size_t>(astc::kRangeTable[static_cast<std::size_t>(range)].levels);
  std::vector<std::uint8_t> sorted(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(levels));
  for (std::size_t i = 0; i < levels; ++i) made.code[values[i]] = static_cast<std::uint8_t>(i);
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t i = 0; i < levels; ++i) {
    made.below[sorted[i]] = sorted[i == 0 ? 0 : i - 1];
    made.above[sorted[i]] = sorted[std::min(i + 1, levels - 1)];
  }
  for (int kept = 0; kept <= 4; ++kept) {
    for (int byte = 0; byte < 256; ++byte) {
      int best = -1;
      for (const int value : sorted) {
        if ((value ^ byte) >> (8 - kept) != 0) continue;
        if (best < 0 || std::abs(value - byte) < std::abs(best - byte)) best = value;
      }
      made.nearest[static_cast<std::size_t>(kept)][static_cast<std::size_t>(byte)] =
          static_cast<std::uint8_t>(best);
    }
  }
  return made;
}

}  // namespace

const StoredValues& StoredValues::of(int range) {
  static const std::array<StoredValues, astc::kRanges> all = [] {
    std::array<StoredValues, astc::kRanges> made{};
    // Below 40 levels none is used, and three bits can't always be kept.
    for (int i = astc::range_of(40); i < astc::kRanges; ++i) made[static_cast<std::size_t>(i)] = made_of(i);
    return made;
  }();
  return all[static_cast<std::size_t>(range)];
}

bool StoredEnds::legal() const {
  return std::all_of(&ends[0][0], &ends[0][0] + 6, [](int each) { return each <= kLargestEnd; });
}

Layouts direct_layouts(const float (*ends)[3], int finer) {
  const float* high = ends[1];
  const int largest = largest_of(high);
  const float c = high[largest] - ends[0][largest];
  float b = 0, d = 0;
  for (int k = 0; k < 3; ++k) {
    b = std::max(b, high[largest] - high[k]);
    d = std::max(d, std::abs(high[k] - c - ends[0][k]));
  }
  Layouts layouts;
  int layout = 7;
  for (; layout >= 0; --layout) {
    const astc::DirectMode& bits = astc::kDirectModes[layout];
    const auto unit = static_cast<float>(1 << bits.shift);
    const auto holds = [&](float difference, int width) {
      return difference < (static_cast<float>(1 << width) - 0.5f) * unit;
    };
    if (holds(b, bits.b) && holds(c, bits.c) && holds(d, bits.d - 1)) break;
  }
  if (layout >= 0) layouts.add(layout);
  if (layout < 0) layouts.add(8);
  for (int k = 1; k <= finer && layout + k <= 7; ++k) layouts.add(layout + k);
  return layouts;
}

Layouts scale_layouts(const float* end, float scale, int finer) {
  const int largest = largest_of(end);
  float other = 0;
  for (int k = 0; k < 3; ++k) other = std::max(other, end[largest] - end[k]);
  int layout = 0;
  for (; layout < 5; ++layout) {
    const astc::ScaleMode& bits = astc::kScaleModes[layout];
    const auto unit = static_cast<float>(1 << bits.shift);
    const auto holds = [&](float difference, int width) {
      return difference < (static_cast<float>(1 << width) - 0.5f) * unit;
    };
    if (holds(other, bits.other) && holds(scale, bits.scale)) break;
  }
  Layouts layouts;
  layouts.add(layout);
  for (int k = 1; k <= finer && layout - k >= 0; ++k) layouts.add(layout - k);
  return layouts;
}

StoredEnds store_direct(const float (*ends)[3], int layout, const StoredValues& range) {
  StoredEnds out;
  if (layout == 8) {
    for (int e = 0; e < 2; ++e) {
      for (int c = 0; c < 3; ++c) {
        const float unit = c < 2 ? 16 : 32;
        const int value = rounded(ends[e][c] / unit, 0, c < 2 ? 255 : 127) | (c == 2 ? 0x80 : 0);
        out.values[2 * c + e] = range.nearest[c < 2 ? 0 : 1][static_cast<std::size_t>(value)];
      }
    }
    astc::decode_direct(out.values, out.ends);
    return out;
  }
  const astc::DirectMode& bits = astc::kDirectModes[layout];
  const float* high = ends[1];
  const int largest = largest_of(high);
  const int others[2] = {largest == 1 ? 0 : 1, largest == 2 ? 0 : 2};
  const float unit = static_cast<float>(1 << bits.shift), per_unit = 1 / unit;
  int field[6];
  const auto extra = [&](int x) {
    const Extra& each = kDirectExtras[layout][x];
    return static_cast<unsigned>(field[each.field] >> each.bit & 1);
  };
  const auto mode_bit = [&](int i) { return static_cast<unsigned>(layout >> i & 1) << 7; };
  field[kA] = rounded(high[largest] * per_unit, 0, (1 << bits.a) - 1);
  out.values[0] = stored(field[kA], 0, 8, range);
  const float a = static_cast<float>(field[kA]) * unit;
  field[kC] = rounded((a - ends[0][largest]) * per_unit, 0, (1 << bits.c) - 1);
  out.values[1] = stored(field[kC], mode_bit(0) | static_cast<unsigned>(field[kA] >> 8 & 1) << 6, 6, range);
  const float c = static_cast<float>(field[kC]) * unit;
  for (int k = 0; k < 2; ++k) {
    field[kB0 + k] = rounded((a - high[others[k]]) * per_unit, 0, (1 << bits.b) - 1);
    out.values[2 + k] = stored(field[kB0 + k], mode_bit(1 + k) | extra(k) << 6, 6, range);
  }
  for (int k = 0; k < 2; ++k) {
    const float b = static_cast<float>(field[kB0 + k]) * unit;
    const int half = 1 << (bits.d - 1);
    field[kD0 + k] = rounded((a - b - c - ends[0][others[k]]) * per_unit, -half, half - 1);
    unsigned above = static_cast<unsigned>(largest >> k & 1) << 7 | extra(2 + k) << 6 | extra(4 + k) << 5;
    // The sign is kept, wherever it is.
    if (bits.d == 5) above |= static_cast<unsigned>(field[kD0 + k] >> 4 & 1) << 4;
    out.values[4 + k] = stored(field[kD0 + k], above, bits.d == 5 ? 4 : 5, range);
  }
  astc::decode_direct(out.values, out.ends);
  return out;
}

StoredEnds store_scale(const float* end, float scale, int layout, const StoredValues& range) {
  StoredEnds out;
  const astc::ScaleMode& bits = astc::kScaleModes[layout];
  const bool absolute = layout == 5;
  const int largest = absolute ? 0 : largest_of(end);
  const int others[2] = {largest == 1 ? 0 : 1, largest == 2 ? 0 : 2};
  const unsigned word = layout < 4    ? static_cast<unsigned>(largest << 2 | layout)
                        : layout == 4 ? 12u | static_cast<unsigned>(largest)
                                      : 15u;
  const float unit = static_cast<float>(1 << bits.shift), per_unit = 1 / unit;
  int field[4];
  const auto extra = [&](int x) {
    const Extra& each = kScaleExtras[layout][x];
    return static_cast<unsigned>(field[each.field] >> each.bit & 1);
  };
  field[kR] = rounded(end[largest] * per_unit, 0, (1 << bits.largest) - 1);
  out.values[0] = stored(field[kR], (word & 3) << 6, 6, range);
  const float r = static_cast<float>(field[kR]) * unit;
  for (int k = 0; k < 2; ++k) {
    const float value = absolute ? end[others[k]] : r - end[others[k]];
    field[kG + k] = rounded(value * per_unit, 0, (1 << bits.other) - 1);
    out.values[1 + k] = stored(
        field[kG + k], (word >> (2 + k) & 1) << 7 | extra(2 * k) << 6 | extra(2 * k + 1) << 5, 5, range);
  }
  field[kS] = rounded(scale * per_unit, 0, (1 << bits.scale) - 1);
  out.values[3] = stored(field[kS], extra(4) << 7 | extra(5) << 6 | extra(6) << 5, 5, range);
  astc::decode_base_and_scale(out.values, out.ends);
  return out;
}

}  // namespace welkin::texture::uastc
