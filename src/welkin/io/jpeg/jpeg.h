#pragma once

#include "welkin/io/format.h"

namespace welkin::io {

/// Grey and YCbCr or RGB JPEG, sequential and progressive, 8 bits. An Exif orientation is noted and not
/// applied. Data that the decoder could only guess at (truncated, bad codes) is an error.
std::unique_ptr<FormatReader> open_jpeg(const Source& source);

/// Writes baseline JPEG at WriteOptions::quality, colour at full resolution (4:4:4); attributes as a comment
/// of lines name=value.
WriteReport write_jpeg(ByteSink& file, std::span<const WritePart> parts, const WriteOptions& options);

}  // namespace welkin::io
