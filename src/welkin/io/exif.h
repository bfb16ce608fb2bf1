#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace welkin::io {

/// The orientation, 1…8, that an Exif block (starting at its TIFF header, `II*` or `MM*`) gives its picture;
/// nothing when it gives none or is malformed. 1 is upright (JEITA CP-3451, tag 0x0112).
std::optional<int> exif_orientation(std::span<const std::byte> exif);

}  // namespace welkin::io
