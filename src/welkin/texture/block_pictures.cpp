#include "welkin/texture/block_pictures.h"

#include <Imath/half.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "welkin/base/error.h"
#include "welkin/base/parallel.h"

namespace welkin {

ClampedValues& ClampedValues::operator+=(const ClampedValues& other) {
  above += other.above;
  below += other.below;
  not_a_number += other.not_a_number;
  return *this;
}

namespace texture {
namespace {

constexpr int kSide = 4, kTexels = kSide * kSide, kBlockBytes = 16;

std::uint16_t half_of(float value, ClampedValues& clamped) {
  constexpr float kLargest = 65504;
  if (value >= 0 && value <= kLargest) return imath_float_to_half(value);
  if (value > kLargest) {
    ++clamped.above;
    return imath_float_to_half(kLargest);
  }
  ++(std::isnan(value) ? clamped.not_a_number : clamped.below);
  return 0;
}

int blocks_along(int texels) {
  return (texels + kSide - 1) / kSide;
}

void check_bytes(std::size_t bytes, int width, int height) {
  require(bytes == bytes_of_blocks(width, height), "blocks take 16 bytes for each 4×4 texels");
}

}  // namespace

std::size_t bytes_of_blocks(int width, int height) {
  require(width >= 1 && height >= 1, "a picture has at least one texel");
  return std::size_t{kBlockBytes} * static_cast<std::size_t>(blocks_along(width)) *
         static_cast<std::size_t>(blocks_along(height));
}

ClampedValues encode_picture(ImageView<const float> picture, const EncodeRow& encode,
                             std::span<std::byte> blocks, const Monitor& monitor) {
  check_bytes(blocks.size(), picture.width, picture.height);
  require(picture.channels == 1 || picture.channels >= 3, "blocks are encoded of one channel or three");
  const int across = blocks_along(picture.width), down = blocks_along(picture.height);
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
        encode(halves.data(), static_cast<std::size_t>(across),
               blocks.data() + std::ptrdiff_t{row} * across * kBlockBytes);
      },
      monitor);
  ClampedValues all;
  for (const ClampedValues& each : clamped) all += each;
  return all;
}

void decode_picture(std::span<const std::byte> blocks, int channels, const DecodeBlock& decode,
                    ImageView<float> picture) {
  check_bytes(blocks.size(), picture.width, picture.height);
  const int across = blocks_along(picture.width);
  parallel_for(blocks_along(picture.height), [&](int row) {
    std::uint16_t halves[4 * kTexels];
    for (int column = 0; column < across; ++column) {
      decode(blocks.data() + (std::ptrdiff_t{row} * across + column) * kBlockBytes, halves);
      const std::uint16_t* half = halves;
      for (int j = 0; j < kSide; ++j) {
        for (int i = 0; i < kSide; ++i, half += channels) {
          const int x = kSide * column + i, y = kSide * row + j;
          if (x >= picture.width || y >= picture.height) continue;
          for (int c = 0; c < std::min(channels, picture.channels); ++c)
            picture.at(x, y)[c] = imath_half_to_float(half[c]);
        }
      }
    }
  });
}

}  // namespace texture
}  // namespace welkin
