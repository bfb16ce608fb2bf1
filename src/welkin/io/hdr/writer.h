#pragma once

#include "welkin/io/format.h"

namespace welkin::io {

/// Writes RGBE, run-length coded by components (compression `rle`) or flat (`none`, and always at widths that
/// the coding cannot have), rounded to nearest. Grey is stored three times. Values are radiance, so EXPOSURE,
/// COLORCORR, FORMAT and PIXASPECT of the attributes, which describe the pixels of another file, are left
/// out.
WriteReport write_hdr(ByteSink& file, std::span<const WritePart> parts, const WriteOptions& options);

}  // namespace welkin::io
