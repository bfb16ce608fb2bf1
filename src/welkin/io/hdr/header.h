#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "welkin/io/format.h"

namespace welkin::io {

/// The text at the head of a Radiance picture (Ward, "Radiance File Formats", 1997) and the order of its
/// pixels.
///
/// EXPOSURE and COLORCORR are multipliers that were applied to the pixels; each may occur several times, and
/// their product applies. Radiance is the stored value divided by them. Lines that begin with white space
/// come from the pictures that this one was made of, and say nothing of it.
struct HdrHeader {
  bool xyze = false;
  double divisor[3] = {1, 1, 1};  ///< EXPOSURE·COLORCORR of R, G, B
  double gamma = 1;               ///< linear = stored^gamma, and is what the divisor divides
  std::optional<Chromaticities> primaries;
  std::map<std::string, std::string>
      attributes;  ///< all lines but FORMAT; those that are not name=value under `history`
  std::vector<std::string> notes;
  std::vector<std::string> warnings;

  int width = 0;
  int height = 0;
  bool columns = false;       ///< scan lines are columns (X stands first in the resolution line)
  bool from_right = false;    ///< −X: x falls along the file
  bool from_bottom = false;   ///< +Y: y rises along the file, so the image row falls
  std::size_t pixels_at = 0;  ///< byte offset of the first scan line

  int lines() const { return columns ? width : height; }
  int line_length() const { return columns ? height : width; }
};

/// Whether the file is a Radiance picture: it begins with `#?`, or, as those of the time before that mark, is
/// lines of text of which one says FORMAT=32-bit_rle_…, or whose first empty line a resolution line follows.
bool is_hdr(std::span<const std::byte> bytes);

/// Throws Error when the header is not one, or check_size does.
HdrHeader parse_hdr_header(const Source& source);

}  // namespace welkin::io
