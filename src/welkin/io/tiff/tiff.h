#pragma once

#include "welkin/io/format.h"

namespace welkin::io {

/// TIFF and BigTIFF: grey, RGB and any number of further samples of 8, 16 and 32-bit integers, half, float
/// and double, in strips or tiles, contiguous or planar, with any compression libtiff has; LogLuv as linear
/// RGB; palettes, bilevel, CMYK and Lab as 8-bit RGB. Each directory is a part.
std::unique_ptr<FormatReader> open_tiff(const Source& source);

/// Writes float by default, in strips, compressed by `zip` (`none`, `lzw`), one directory per part; BigTIFF
/// when the pixels could pass 4 GiB. Attributes are lines name=value of the first directory's
/// ImageDescription. Channels other than Y, R G B and A keep their names in the line `welkin:channels`.
WriteReport write_tiff(ByteSink& file, std::span<const WritePart> parts, const WriteOptions& options);

/// The attribute that names the samples of a TIFF, comma separated.
inline constexpr const char* kTiffChannels = "welkin:channels";

}  // namespace welkin::io
