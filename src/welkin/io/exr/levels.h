#pragma once

#include <ImfForward.h>

#include <span>
#include <vector>

#include "welkin/io/exr/header.h"

/// Mip pyramids, which EXR keeps as the levels of one tiled picture: level l has max(1, size >> l) texels.
namespace welkin::io::exr {

/// Whether the parts are levels of one picture.
bool are_levels(std::span<const WritePart> parts);

/// The parts by level. Throws Error, the cause only, unless they are levels 0, 1, 2… of one picture: once
/// each, of the sizes above, with the same channels, without layers and faces. Names are left out.
std::vector<WritePart> ordered_levels(std::span<const WritePart> parts);

/// Writes level by level, in tiles of 64×64. `header` is that of level 0. EXR's pyramids go down to 1×1:
/// levels that were not given are averages of 2×2 texels of the one before, and the attribute `welkinLevels`
/// then says how many were given.
WriteReport write_levels(Imf::OStream& stream, Imf::Header header, std::span<const WritePart> levels,
                         StoredType type, int threads);

}  // namespace welkin::io::exr
