#pragma once

#include <cstddef>
#include <span>

#include "welkin/image/image.h"
#include "welkin/video/stream_info.h"

/// Y′CbCr ↔ linear R G B. Source: ITU-R BT.601-7, BT.709-6, BT.2020-2; the places of chroma: mjpegtools,
/// yuv4mpeg(5).
namespace welkin::video {

/// Bytes of a frame of a y4m: luma, then both planes of chroma; two a value, the lower first, where it has
/// more than 8 bits.
std::size_t yuv_bytes(const StreamInfo& info);

/// A frame's planes to linear R G B (or Y of mono) in 0 … 1. What no R′G′B′ has is clipped. In parallel.
void decode_yuv(const StreamInfo& info, const StreamColour& colour, std::span<const std::byte> planes,
                ImageView<float> out);

/// The reverse, rounded to nearest: chroma is averaged over what a sample stands for. `frame` has three
/// channels, of mono one, and values in 0 … 1.
void encode_yuv(const StreamInfo& info, const StreamColour& colour, ImageView<const float> frame,
                std::span<std::byte> planes);

}  // namespace welkin::video
