#pragma once

#include <span>

#include "welkin/io/format.h"

namespace welkin::io::exr {

/// Writes scan-line OpenEXR. Half, float (the default) and uint32; compressions none, rle, zips, zip (the
/// default), piz, pxr24, b44, b44a, dwaa and dwab, the last two at level 9·(100 − quality), which is
/// OpenEXR's 45 for quality 95. Two or more parts need unique names and make a multi-part file; parts of
/// unequal size share a display window as large as the largest, and keep their own in the attribute
/// `welkinWindow`. Parts with levels make a mipmapped file of tiles (exr_levels.h).
///
/// Attributes are written as strings, but for the names that EXR gives another type, which are left out.
/// In half, finite values beyond ±65504 are clipped to it and counted in WriteReport::above. In uint32,
/// values are rounded to nearest; negative ones become 0 (`below`), those over 2^32 − 1 are clipped
/// (`above`), and NaN and infinities are counted in `not_finite` and written as 0. Float keeps everything.
/// The same input gives the same bytes. Throws Error, the cause only.
/// Throws Error for a type or a compression that EXR lacks.
void check_exr_options(const WriteOptions& options);

WriteReport write_exr(ByteSink& file, std::span<const WritePart> parts, const WriteOptions& options);

}  // namespace welkin::io::exr
