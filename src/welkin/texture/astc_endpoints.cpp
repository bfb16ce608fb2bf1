#include "welkin/texture/astc_endpoints.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace welkin::texture::astc {
namespace {

constexpr int kOne = 0x780;  // 1 as a logarithm of 12 bits

struct Colour {
  int r, g, b, a;
};

void transfer_bit(int& a, int& b) {
  b = b >> 1 | (a & 0x80);
  a = a >> 1 & 0x3f;
  if ((a & 0x20) != 0) a -= 0x40;
}

Colour contracted(int r, int g, int b, int a) {
  return {(r + b) >> 1, (g + b) >> 1, b, a};
}

int sign_extended(int value, int bits) {
  value &= (1 << bits) - 1;
  return (value & 1 << (bits - 1)) != 0 ? value - (1 << bits) : value;
}

int logarithm(int value) {
  return std::clamp(value, 0, 0xfff);
}

/// Of the modes with direct colours, R G B or R G B A.
void ldr_direct(const int* v, int a0, int a1, Colour& first, Colour& second) {
  if (v[1] + v[3] + v[5] >= v[0] + v[2] + v[4]) {
    first = {v[0], v[2], v[4], a0};
    second = {v[1], v[3], v[5], a1};
  } else {
    first = contracted(v[1], v[3], v[5], a1);
    second = contracted(v[0], v[2], v[4], a0);
  }
}

/// Of those with offsets. `a1` is alpha's offset.
void ldr_offset(int* v, int a0, int a1, Colour& first, Colour& second) {
  transfer_bit(v[1], v[0]);
  transfer_bit(v[3], v[2]);
  transfer_bit(v[5], v[4]);
  if (v[1] + v[3] + v[5] >= 0) {
    first = {v[0], v[2], v[4], a0};
    second = {v[0] + v[1], v[2] + v[3], v[4] + v[5], a0 + a1};
  } else {
    first = contracted(v[0] + v[1], v[2] + v[3], v[4] + v[5], a0 + a1);
    second = contracted(v[0], v[2], v[4], a0);
  }
}

/// The two alphas of HDR mode 15.
std::pair<int, int> hdr_alphas(int v6, int v7) {
  const int mode = (v6 >> 7 & 1) | (v7 >> 6 & 2);
  v6 &= 0x7f;
  v7 &= 0x7f;
  if (mode == 3) return {v6 << 5, v7 << 5};
  v6 |= v7 << (mode + 1) & 0x780;
  v7 &= 0x3f >> mode;
  v7 ^= 0x20 >> mode;
  v7 -= 0x20 >> mode;
  v6 *= 1 << (4 - mode);
  v7 *= 1 << (4 - mode);
  return {v6, logarithm(v7 + v6)};
}

Endpoints ldr_endpoints(int mode, int* v) {
  Colour first{}, second{};
  switch (mode) {
    case 0:
      first = {v[0], v[0], v[0], 255};
      second = {v[1], v[1], v[1], 255};
      break;
    case 1: {
      const int low = v[0] >> 2 | (v[1] & 0xc0), high = low + (v[1] & 0x3f);
      first = {low, low, low, 255};
      second = {high, high, high, 255};
      break;
    }
    case 4:
      first = {v[0], v[0], v[0], v[2]};
      second = {v[1], v[1], v[1], v[3]};
      break;
    case 5:
      transfer_bit(v[1], v[0]);
      transfer_bit(v[3], v[2]);
      first = {v[0], v[0], v[0], v[2]};
      second = {v[0] + v[1], v[0] + v[1], v[0] + v[1], v[2] + v[3]};
      break;
    case 6:
    case 10:
      first = {v[0] * v[3] >> 8, v[1] * v[3] >> 8, v[2] * v[3] >> 8, mode == 6 ? 255 : v[4]};
      second = {v[0], v[1], v[2], mode == 6 ? 255 : v[5]};
      break;
    case 8:
      ldr_direct(v, 255, 255, first, second);
      break;
    case 9:
      ldr_offset(v, 255, 0, first, second);
      break;
    case 12:
      ldr_direct(v, v[6], v[7], first, second);
      break;
    default:
      transfer_bit(v[7], v[6]);
      ldr_offset(v, v[6], v[7], first, second);
      break;
  }
  Endpoints ends{
      {{first.r, first.g, first.b, first.a}, {second.r, second.g, second.b, second.a}}, false, false};
  for (auto& colour : ends.colour) {
    for (int& value : colour) value = std::clamp(value, 0, 255) * 257;
  }
  return ends;
}

}  // namespace

void decode_base_and_scale(const std::uint8_t* v, int (*ends)[3]) {
  const int word = v[0] >> 6 | (v[1] & 0x80) >> 5 | (v[2] & 0x80) >> 4;
  int largest = 0, mode = 5;
  if ((word & 12) != 12) {
    largest = word >> 2;
    mode = word & 3;
  } else if (word != 15) {
    largest = word & 3;
    mode = 4;
  }
  int red = v[0] & 0x3f, green = v[1] & 0x1f, blue = v[2] & 0x1f, scale = v[3] & 0x1f;
  const int x[7] = {v[1] >> 6 & 1, v[1] >> 5 & 1, v[2] >> 6 & 1, v[2] >> 5 & 1,
                    v[3] >> 7 & 1, v[3] >> 6 & 1, v[3] >> 5 & 1};
  // Where the bits x go, by mode: a set of modes for each.
  const int set = 1 << mode;
  if ((set & 0x30) != 0) green |= x[0] << 6;
  if ((set & 0x3a) != 0) green |= x[1] << 5;
  if ((set & 0x30) != 0) blue |= x[2] << 6;
  if ((set & 0x3a) != 0) blue |= x[3] << 5;
  if ((set & 0x3d) != 0) scale |= x[6] << 5;
  if ((set & 0x2d) != 0) scale |= x[5] << 6;
  if ((set & 0x04) != 0) scale |= x[4] << 7;
  if ((set & 0x3b) != 0) red |= x[4] << 6;
  if ((set & 0x04) != 0) red |= x[3] << 6;
  if ((set & 0x10) != 0) red |= x[5] << 7;
  if ((set & 0x0f) != 0) red |= x[2] << 7;
  if ((set & 0x05) != 0) red |= x[1] << 8;
  if ((set & 0x0a) != 0) red |= x[0] << 8;
  if ((set & 0x05) != 0) red |= x[0] << 9;
  if ((set & 0x02) != 0) red |= x[6] << 9;
  if ((set & 0x01) != 0) red |= x[3] << 10;
  if ((set & 0x02) != 0) red |= x[5] << 10;

  const int shift = kScaleModes[mode].shift;
  red <<= shift;
  green <<= shift;
  blue <<= shift;
  scale <<= shift;
  if (mode != 5) {
    green = red - green;
    blue = red - blue;
  }
  if (largest == 1) std::swap(red, green);
  if (largest == 2) std::swap(red, blue);
  const int colour[3] = {red, green, blue};
  for (int c = 0; c < 3; ++c) {
    ends[1][c] = logarithm(colour[c]);
    ends[0][c] = logarithm(colour[c] - scale);
  }
}

void decode_direct(const std::uint8_t* v, int (*ends)[3]) {
  const int largest = v[4] >> 7 | (v[5] & 0x80) >> 6;
  if (largest == 3) {
    for (int e = 0; e < 2; ++e) {
      ends[e][0] = v[e] << 4;
      ends[e][1] = v[2 + e] << 4;
      ends[e][2] = (v[4 + e] & 0x7f) << 5;
    }
    return;
  }
  const int mode = v[1] >> 7 | (v[2] & 0x80) >> 6 | (v[3] & 0x80) >> 5;
  int a = v[0] | (v[1] & 0x40) << 2, b0 = v[2] & 0x3f, b1 = v[3] & 0x3f, c = v[1] & 0x3f;
  const DirectMode& layout = kDirectModes[mode];
  int d0 = sign_extended(v[4], layout.d), d1 = sign_extended(v[5], layout.d);
  const int x[6] = {v[2] >> 6 & 1, v[3] >> 6 & 1, v[4] >> 6 & 1, v[5] >> 6 & 1, v[4] >> 5 & 1, v[5] >> 5 & 1};
  const int set = 1 << mode;
  if ((set & 0xa4) != 0) a |= x[0] << 9;
  if ((set & 0x08) != 0) a |= x[2] << 9;
  if ((set & 0x50) != 0) a |= x[4] << 9;
  if ((set & 0x50) != 0) a |= x[5] << 10;
  if ((set & 0xa0) != 0) a |= x[1] << 10;
  if ((set & 0xc0) != 0) a |= x[2] << 11;
  if ((set & 0x04) != 0) c |= x[1] << 6;
  if ((set & 0xe8) != 0) c |= x[3] << 6;
  if ((set & 0x20) != 0) c |= x[2] << 7;
  if ((set & 0x5b) != 0) b0 |= x[0] << 6;
  if ((set & 0x5b) != 0) b1 |= x[1] << 6;
  if ((set & 0x12) != 0) b0 |= x[2] << 7;
  if ((set & 0x12) != 0) b1 |= x[3] << 7;

  const int unit = 1 << layout.shift;
  a *= unit;
  b0 *= unit;
  b1 *= unit;
  c *= unit;
  d0 *= unit;
  d1 *= unit;
  ends[1][0] = logarithm(a);
  ends[1][1] = logarithm(a - b0);
  ends[1][2] = logarithm(a - b1);
  ends[0][0] = logarithm(a - c);
  ends[0][1] = logarithm(a - b0 - c - d0);
  ends[0][2] = logarithm(a - b1 - c - d1);
  if (largest == 0) return;
  for (int e = 0; e < 2; ++e) std::swap(ends[e][0], ends[e][largest]);
}

Endpoints endpoints_of(int mode, const std::uint8_t* values) {
  int v[8] = {};
  std::copy_n(values, values_of_mode(mode), v);
  int rgb[2][3], alpha[2] = {kOne, kOne};
  bool hdr_alpha = true;
  switch (mode) {
    case 2:
    case 3: {
      int y[2];
      if (mode == 2) {
        const bool ascending = v[1] >= v[0];
        y[0] = ascending ? v[0] << 4 : (v[1] << 4) + 8;
        y[1] = ascending ? v[1] << 4 : (v[0] << 4) - 8;
      } else {
        const bool coarse = (v[0] & 0x80) != 0;
        y[0] = coarse ? (v[1] & 0xe0) << 4 | (v[0] & 0x7f) << 2 : (v[1] & 0xf0) << 4 | (v[0] & 0x7f) << 1;
        y[1] = logarithm(y[0] + (coarse ? (v[1] & 0x1f) << 2 : (v[1] & 0x0f) << 1));
      }
      for (int e = 0; e < 2; ++e) std::fill_n(rgb[e], 3, y[e]);
      break;
    }
    case 7:
      decode_base_and_scale(values, rgb);
      break;
    case 11:
      decode_direct(values, rgb);
      break;
    case 14:
      decode_direct(values, rgb);
      hdr_alpha = false;
      alpha[0] = v[6] * 257;
      alpha[1] = v[7] * 257;
      break;
    case 15:
      decode_direct(values, rgb);
      std::tie(alpha[0], alpha[1]) = hdr_alphas(v[6], v[7]);
      break;
    default:
      return ldr_endpoints(mode, v);
  }
  Endpoints ends{{}, true, hdr_alpha};
  for (int e = 0; e < 2; ++e) {
    for (int c = 0; c < 3; ++c) ends.colour[e][c] = rgb[e][c] << 4;
    ends.colour[e][3] = hdr_alpha ? alpha[e] << 4 : alpha[e];
  }
  return ends;
}

}  // namespace welkin::texture::astc
