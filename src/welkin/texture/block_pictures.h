#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include "welkin/base/monitor.h"
#include "welkin/image/image.h"

/// Pictures ↔ rows of blocks of 4×4 texels in 16 bytes, whatever is in them.
namespace welkin {

/// Values that a texture can't hold, and what became of them.
struct ClampedValues {
  std::uint64_t above = 0;         ///< over 65504, +infinity among them: became 65504
  std::uint64_t below = 0;         ///< negative, −infinity among them: became 0
  std::uint64_t not_a_number = 0;  ///< became 0

  ClampedValues& operator+=(const ClampedValues& other);
};

namespace texture {

/// Bytes of a picture's blocks, those at its edges as a whole. Throws Error (bad_request) for sizes below 1.
std::size_t bytes_of_blocks(int width, int height);

/// Encodes a row of blocks: of each the halves R G B of 4×4 texels, 0 … 65504, row by row.
using EncodeRow = std::function<void(const std::uint16_t* halves, std::size_t blocks, std::byte* bytes)>;

/// Encodes the first three channels, or a single one three times, row of blocks by row of blocks on all
/// threads. Texels beyond the picture's edge are those of the edge. Throws Error
/// (bad_request) for pictures of two channels, and for another number of bytes than bytes_of_blocks;
/// Cancelled.
ClampedValues encode_picture(ImageView<const float> picture, const EncodeRow& encode,
                             std::span<std::byte> blocks, const Monitor& monitor);

/// Decodes a block to halves, as many of each texel as the block has channels.
using DecodeBlock = std::function<void(const std::byte* bytes, std::uint16_t* halves)>;

/// Decodes blocks of `channels`, at most 4, of which the picture gets as many as it has, the first ones.
/// Throws Error (bad_request) for another number of bytes than bytes_of_blocks.
void decode_picture(std::span<const std::byte> blocks, int channels, const DecodeBlock& decode,
                    ImageView<float> picture);

}  // namespace texture
}  // namespace welkin
