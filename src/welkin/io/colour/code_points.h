#pragma once

#include <optional>

#include "welkin/io/declared.h"
#include "welkin/io/image_file.h"

/// Coding-independent code points (ITU-T H.273): the numbers by which PNG's cICP chunk, JPEG XL, AVIF and
/// HEIF name their primaries and transfer function.
namespace welkin::io {

/// The chromaticities of `primaries` (H.273, table 2). None for 2, which says nothing, and for reserved ones.
std::optional<Chromaticities> chromaticities_of(int primaries);

/// Has `declared` say what both numbers mean: its curve, gamma and primaries, which stay none for BT.709's
/// own. `info.colour` becomes sRGB for the transfer functions that are, or are taken for, sRGB's, linear for
/// all others, whose curve `declared` names. What is not known or not undone adds a warning that says what
/// the number means and what is assumed.
void declare_code_points(int primaries, int transfer, Declared& declared, FileInfo& info);

}  // namespace welkin::io
