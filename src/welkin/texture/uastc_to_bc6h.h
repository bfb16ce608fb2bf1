#pragma once

#include <cstddef>
#include <cstdint>

#include "welkin/texture/bc6h_block.h"
#include "welkin/texture/uastc_endpoints.h"

/// What a block of UASTC HDR becomes as BC6H, by Basis Universal's transcoder: the endpoints rounded to the
/// mode of the highest precision whose differences suffice, the weights to the nearest indices. Internal to
/// texture.
namespace welkin::texture::uastc {

/// Endpoints of each region as BC6H's decoder makes them of 16 bits.
struct Bc6hEnds {
  int wide[2][2][3];
};

/// `first`: which of ASTC's regions is BC6H's first. `from_second`: whether that region's base, from which
/// others are differences, is its second endpoint, because its first texel is nearer to it.
Bc6hEnds as_bc6h(const StoredEnds* ends, int regions, int first, bool from_second);

/// Halves of the block of BC6H that a block becomes, R G B for each texel row by row. False for blocks that
/// aren't of the shapes that are searched for.
bool decode_as_bc6h(const std::byte* bytes, std::uint16_t* halves);

}  // namespace welkin::texture::uastc
