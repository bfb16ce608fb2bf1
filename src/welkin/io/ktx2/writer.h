#pragma once

#include <span>

#include "welkin/io/format.h"

namespace welkin::io::ktx2 {

/// Writes KTX2: a picture, an array of pictures, a cube or an array of cubes, each with levels or without.
/// Parts may come in any order; level 0 decides the size, level l has max(1, size >> l), and every face of
/// every layer of every level must be there. Types float (the default) and half with alpha; rgb9e5,
/// r11g11b10, bc6h and uastc_hdr without (what they lose: texels/texels.h); pictures of R and G alone are
/// stored as two channels. Compressions none (the default, but of uastc_hdr) and zstd (uastc_hdr's), level by
/// level.
///
/// Attributes become keys (ktx2_keys.h). The same input gives the same bytes. Memory: some MiB, or with zstd
/// the whole file. Throws Error, the cause only.
WriteReport write_ktx2(ByteSink& file, std::span<const WritePart> parts, const WriteOptions& options);

}  // namespace welkin::io::ktx2
