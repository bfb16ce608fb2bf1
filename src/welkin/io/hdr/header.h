#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "welkin/io/format.h"

namespace welkin::io {

/// The text at the head of a Radiance picture (Ward, "Radiance File Formats", 1997) and the order of its
/// pixels.
///
/// EXPOSURE and COLORCORR are multipliers that were applied to the pixels; each may occur several times, and
/// their product applies. Radiance is the stored value divided by them.
struct HdrHeader {
  bool xyze = false;
  double divisor[3] = {1, 1, 1};  ///< EXPOSURE·COLORCORR of R, G, B
  std::map<std::string, std::string>
      attributes;  ///< all lines but FORMAT; those that are not name=value under `history`
  std::vector<std::string> notes;

  int width = 0;
  int height = 0;
  bool columns = false;       ///< scan lines are columns (X stands first in the resolution line)
  bool from_right = false;    ///< −X: x falls along the file
  bool from_bottom = false;   ///< +Y: y rises along the file, so the image row falls
  std::size_t pixels_at = 0;  ///< byte offset of the first scan line

  int lines() const { return columns ? width : height; }
  int line_length() const { return columns ? height : width; }
};

/// Throws Error when the header is not one, or check_size does.
HdrHeader parse_hdr_header(const Source& source);

}  // namespace welkin::io
