#pragma once

#include <cstddef>
#include <span>

#include "welkin/base/monitor.h"
#include "welkin/image/image.h"
#include "welkin/texture/block_pictures.h"
#include "welkin/texture/texture_quality.h"

/// Pictures ↔ blocks of BC6H, the textures of half floats that graphics cards read: 4×4 texels of R G B in 16
/// bytes, row by row of blocks. docs/benchmarks.md has the errors.
namespace welkin {

/// Bytes of a picture's blocks, those at its edges as a whole. Throws Error (bad_request) for sizes below 1.
std::size_t bc6h_bytes(int width, int height);

/// Encodes the unsigned format: of the first three channels, or of a single one three times. Texels of blocks
/// beyond the picture's edge are those of the edge. The same bytes whatever the number of threads;
/// instruction sets may choose differently between encodings that are as good. Throws Error (bad_request) for
/// pictures of two channels, and for another number of bytes than bc6h_bytes; Cancelled.
ClampedValues encode_bc6h(ImageView<const float> picture, TextureQuality quality, std::span<std::byte> blocks,
                          const Monitor& monitor = {});

/// Decodes to R G B, exactly as graphics cards do. Blocks of reserved modes are black. Throws Error
/// (bad_request) for another number of bytes than bc6h_bytes, and for pictures of other than three channels.
void decode_bc6h(std::span<const std::byte> blocks, bool is_signed, ImageView<float> picture);

}  // namespace welkin
