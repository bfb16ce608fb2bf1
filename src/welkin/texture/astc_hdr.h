#pragma once

#include <cstddef>
#include <span>

#include "welkin/base/monitor.h"
#include "welkin/image/image.h"
#include "welkin/texture/block_pictures.h"
#include "welkin/texture/texture_quality.h"

/// Pictures ↔ blocks of ASTC HDR 4×4: 4×4 texels in 16 bytes, row by row of blocks. Written are the blocks of
/// UASTC HDR 4×4, a part of ASTC HDR that becomes BC6H without being searched again. docs/benchmarks.md has
/// the errors.
namespace welkin {

/// Bytes of a picture's blocks, those at its edges as a whole. Throws Error (bad_request) for sizes below 1.
std::size_t astc_bytes(int width, int height);

/// Encodes the first three channels, or a single one three times. Texels of blocks beyond the picture's edge
/// are those of the edge. The same bytes whatever the number of threads; instruction sets may choose
/// differently between encodings that are as good. Throws Error (bad_request) for pictures of two channels,
/// and for another number of bytes than astc_bytes; Cancelled.
ClampedValues encode_uastc_hdr(ImageView<const float> picture, TextureQuality quality,
                               std::span<std::byte> blocks, const Monitor& monitor = {});

/// Decodes any ASTC 4×4 of the HDR profile, bit for bit, to R G B or R G B A. Blocks that the format forbids
/// are magenta, 1 0 1, as it says; infinity and NaN in blocks of one colour become the largest half. Throws
/// Error (bad_request) for another number of bytes than astc_bytes, and for pictures of other than three or
/// four channels.
void decode_astc_hdr(std::span<const std::byte> blocks, ImageView<float> picture);

}  // namespace welkin
