#include "welkin/texture/bc6h.h"

#include <Imath/half.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "welkin/base/cpu.h"
#include "welkin/base/error.h"
#include "welkin/base/parallel.h"
#include "welkin/texture/bc6h_encoder.h"

namespace welkin {
namespace {

using namespace texture::bc6h;

constexpr int kSide = 4, kBlockBytes = 16;

Search search_of(TextureQuality quality) {
  switch (quality) {
    case TextureQuality::fast:
      return {1, 1, 1, false, false};
    case TextureQuality::normal:
      return {2, 1, 2, true, false};
    default:
      return {3, 1, 2, true, true};
  }
}

EncodeBlocks encoder() {
#ifdef WELKIN_HAS_AVX2
  if (instruction_set() == InstructionSet::avx2) return encoder_avx2();
#endif
  return encoder_baseline();
}

std::uint16_t half_of(float value, ClampedValues& clamped) {
  if (value >= 0 && value <= 65504.0f) return imath_float_to_half(value);
  if (value > 65504.0f) {
    ++clamped.above;
    return kLargestHalf;
  }
  ++(std::isnan(value) ? clamped.not_a_number : clamped.below);
  return 0;
}

int blocks_along(int texels) {
  return (texels + kSide - 1) / kSide;
}

void check_bytes(std::size_t bytes, int width, int height) {
  require(bytes == bc6h_bytes(width, height), "BC6H has 16 bytes for each 4×4 texels");
}

}  // namespace

ClampedValues& ClampedValues::operator+=(const ClampedValues& other) {
  above += other.above;
  below += other.below;
  not_a_number += other.not_a_number;
  return *this;
}

std::size_t bc6h_bytes(int width, int height) {
  require(width >= 1 && height >= 1, "a picture has at least one texel");
  return std::size_t{kBlockBytes} * static_cast<std::size_t>(blocks_along(width)) *
         static_cast<std::size_t>(blocks_along(height));
}

ClampedValues encode_bc6h(ImageView<const float> picture, TextureQuality quality, std::span<std::byte> blocks,
                          const Monitor& monitor) {
  check_bytes(blocks.size(), picture.width, picture.height);
  require(picture.channels == 1 || picture.channels >= 3, "BC6H holds three channels");
  const int across = blocks_along(picture.width), down = blocks_along(picture.height);
  const Search search = search_of(quality);
  const EncodeBlocks encode = encoder();
  std::vector<ClampedValues> clamped(static_cast<std::size_t>(down));
  parallel_for(
      down,
      [&](int row) {
        ClampedValues& counts = clamped[static_cast<std::size_t>(row)];
        std::vector<std::uint16_t> halves(static_cast<std::size_t>(across) * 3 * kTexels);
        for (int j = 0; j < kSide; ++j) {
          const int y = kSide * row + j;
          const float* texels = picture.row(std::min(y, picture.height - 1));
          for (int x = 0; x < kSide * across; ++x) {
            const float* texel = texels + std::ptrdiff_t{std::min(x, picture.width - 1)} * picture.channels;
            std::uint16_t* to =
                &halves[static_cast<std::size_t>(3 * (kTexels * (x / kSide) + kSide * j + x % kSide))];
            // Repeated texels count once.
            ClampedValues repeated;
            ClampedValues& count = x < picture.width && y < picture.height ? counts : repeated;
            for (int c = 0; c < 3; ++c) to[c] = half_of(texel[picture.channels == 1 ? 0 : c], count);
          }
        }
        encode(halves.data(), static_cast<std::size_t>(across), search,
               blocks.data() + std::ptrdiff_t{row} * across * kBlockBytes);
      },
      monitor);
  ClampedValues all;
  for (const ClampedValues& each : clamped) all += each;
  return all;
}

void decode_bc6h(std::span<const std::byte> blocks, bool is_signed, ImageView<float> picture) {
  check_bytes(blocks.size(), picture.width, picture.height);
  require(picture.channels == 3, "BC6H holds three channels");
  const int across = blocks_along(picture.width);
  parallel_for(blocks_along(picture.height), [&](int row) {
    std::uint16_t halves[3 * kTexels];
    for (int column = 0; column < across; ++column) {
      decode(blocks.data() + (std::ptrdiff_t{row} * across + column) * kBlockBytes, is_signed, halves);
      const std::uint16_t* half = halves;
      for (int j = 0; j < kSide; ++j) {
        for (int i = 0; i < kSide; ++i, half += 3) {
          const int x = kSide * column + i, y = kSide * row + j;
          if (x >= picture.width || y >= picture.height) continue;
          for (int c = 0; c < 3; ++c) picture.at(x, y)[c] = imath_half_to_float(half[c]);
        }
      }
    }
  });
}

}  // namespace welkin
