#pragma once

#include <tiffio.h>

#include "welkin/io/tiff/page.h"

namespace welkin::io {

/// Fills in what the current directory says of its pixels beyond how they are coded: orientation, XMP, what
/// it is cut out of, and, where `rgb` says that they are what its colour fields describe, the ICC profile and
/// primaries. Alpha is the caller's.
void declare_tiff_page(TIFF* tiff, bool rgb, TiffPage& page);

}  // namespace welkin::io
