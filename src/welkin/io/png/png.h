#pragma once

#include "welkin/io/format.h"

namespace welkin::io {

/// PNG of 8 and 16 bits (fewer are expanded to 8, palettes to colours), with transparency as alpha. Its
/// colour, when automatic: linear if cICP or gAMA says so, sRGB otherwise.
std::unique_ptr<FormatReader> open_png(const Source& source);

/// Writes 16 bits by default; attributes as tEXt, or iTXt where they are not ASCII.
WriteReport write_png(ByteSink& file, std::span<const WritePart> parts, const WriteOptions& options);

}  // namespace welkin::io
