#pragma once

#include "welkin/io/format.h"

namespace welkin::io {

/// TIFF and BigTIFF: grey, RGB and any number of further samples of integers of up to 32 bits, signed or not,
/// half, 24-bit float, float and double, in strips or tiles, contiguous or planar, with any compression
/// libtiff has; LogLuv as linear RGB; palettes, CMYK and Lab as 8-bit RGB. Each directory is a part. What the
/// first says of orientation, alpha and colour is declared for all.
std::unique_ptr<FormatReader> open_tiff(const Source& source);

/// Writes float by default, in strips, compressed by `zip` (`none`, `lzw`), one directory per part; BigTIFF
/// when the pixels could pass 4 GiB. Attributes are lines name=value of the first directory's
/// ImageDescription. Alpha is said to be associated where values are linear, unassociated where they are
/// encoded. Channels other than Y, R G B and A keep their names in the line `welkin:channels`.
WriteReport write_tiff(ByteSink& file, std::span<const WritePart> parts, const WriteOptions& options);

/// The attribute that names the samples of a TIFF, comma separated.
inline constexpr const char* kTiffChannels = "welkin:channels";

}  // namespace welkin::io
