#include "welkin/texture/uastc_to_bc6h.h"

#include <algorithm>

#include "welkin/texture/astc_block.h"
#include "welkin/texture/astc_endpoints.h"
#include "welkin/texture/uastc_encoder.h"

namespace welkin::texture::uastc {
namespace {

/// By precision; the last takes any endpoints.
constexpr int kOneRegion[] = {13, 12, 11, 10}, kTwoRegions[] = {2, 3, 4, 0, 5, 6, 7, 8, 1, 9};

}  // namespace

Bc6hEnds as_bc6h(const StoredEnds* ends, int regions, int first, bool from_second) {
  int full[2][2][3];
  for (int c = 0; c < 3; ++c) {
    for (int r = 0; r < regions; ++r) {
      for (int e = 0; e < 2; ++e)
        full[r][e][c] = (astc::half_of_logarithm(ends[r].ends[e][c] << 4) * 64 + 30) / 31;
    }
  }
  const int* base = full[first][from_second ? 1 : 0];
  const auto fits = [&](const bc6h::Mode& mode) {
    const int shift = 16 - mode.precision;
    for (int c = 0; c < 3; ++c) {
      const int half = 1 << (mode.other_bits[c] - 1), from = base[c] >> shift;
      for (int r = 0; r < regions; ++r) {
        for (int e = 0; e < 2; ++e) {
          const int difference = (full[r][e][c] >> shift) - from;
          if (difference < -half || difference >= half) return false;
        }
      }
    }
    return true;
  };
  const int* modes = regions == 1 ? kOneRegion : kTwoRegions;
  const bc6h::Mode* mode = &bc6h::kModeTable[static_cast<std::size_t>(*modes)];
  while (mode->differences && !fits(*mode)) mode = &bc6h::kModeTable[static_cast<std::size_t>(*++modes)];
  Bc6hEnds out{};
  for (int r = 0; r < regions; ++r) {
    for (int e = 0; e < 2; ++e) {
      for (int c = 0; c < 3; ++c)
        out.wide[r][e][c] = bc6h::unquantized(full[r][e][c] >> (16 - mode->precision), mode->precision);
    }
  }
  return out;
}

bool decode_as_bc6h(const std::byte* bytes, std::uint16_t* halves) {
  astc::Block block;
  if (!astc::unpack(bytes, block)) return false;
  if (block.one_colour) {
    for (int i = 0; i < 3 * astc::kTexels; ++i) halves[i] = block.colour[i % 3];
    return block.hdr_colour;
  }
  const auto shape = std::find_if(kShapeTable.begin(), kShapeTable.end(), [&](const Shape& each) {
    return each.partitions == block.partitions && each.weight_range == block.weight_range &&
           std::all_of(block.modes, block.modes + block.partitions,
                       [&](int mode) { return mode == each.mode; });
  });
  const auto& partitions = Tables::get().partitions;
  const auto partition = std::find_if(partitions.begin(), partitions.end(),
                                      [&](const Partition& each) { return each.seed == block.seed; });
  if (shape == kShapeTable.end() || block.two_planes || block.grid_height != astc::kSide ||
      block.grid_width != astc::kSide || (block.partitions == 2 && partition == partitions.end()))
    return false;

  StoredEnds ends[2];
  for (int r = 0; r < block.partitions; ++r) {
    const auto& values = astc::endpoint_values(block.endpoint_range);
    for (int i = 0; i < shape->values(); ++i)
      ends[r].values[i] = values[block.endpoints[r * shape->values() + i]];
    shape->mode == 7 ? astc::decode_base_and_scale(ends[r].values, ends[r].ends)
                     : astc::decode_direct(ends[r].values, ends[r].ends);
    if (!ends[r].legal()) return false;
  }
  const Weights& weights = Tables::get().weights[static_cast<std::size_t>(block.weight_range)];
  const auto weight_of = [&](int texel) {
    const auto* code = std::find(weights.code, weights.code + weights.count, block.weights[texel]);
    return weights.bc6h[code - weights.code];
  };
  // The first texel's index has a bit less: its region's endpoints are swapped where it is nearer to the
  // second.
  const bool swapped = block.partitions == 2 && partition->swapped;
  const Bc6hEnds as = as_bc6h(ends, block.partitions, swapped ? 1 : 0, weight_of(0) > 32);
  for (int i = 0; i < astc::kTexels; ++i) {
    const int r = block.partitions == 2 ? partition->second >> i & 1 : 0, w = weight_of(i);
    for (int c = 0; c < 3; ++c)
      *halves++ = static_cast<std::uint16_t>(bc6h::interpolated(as.wide[r][0][c], as.wide[r][1][c], w));
  }
  return true;
}

}  // namespace welkin::texture::uastc
