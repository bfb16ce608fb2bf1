#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

/// What a file says of its stored pixels beyond how they are coded. A format fills this in when it opens;
/// interpret.h obeys it, in one place for all formats.
namespace welkin::io {

class GainMap;

/// CIE 1931 x, y of three primaries and of white.
struct Chromaticities {
  double red[2], green[2], blue[2], white[2];
  bool operator==(const Chromaticities&) const = default;
};

/// A transfer function that a format leaves to be undone, besides those of Colour.
enum class Curve {
  none,   ///< values are linear when the format has decoded them
  gamma,  ///< linear = stored^gamma, Declared::gamma
  bt709,  ///< ITU-R BT.709's camera curve
  pq,     ///< SMPTE ST 2084: absolute luminance
  hlg,    ///< ARIB STD-B67, ITU-R BT.2100
};

/// What the channel `A` did to the colours beside it.
enum class AlphaKind {
  associated,  ///< colours are multiplied by it (or there is none); as reading gives them
  straight,    ///< colours are whole; reading multiplies them once they are linear
  encoded,     ///< the stored, encoded colours are multiplied by it, as in a TIFF of sRGB bytes
};

struct Declared {
  /// Exif's (JEITA CP-3451, tag 0x0112): how rows and columns run, 1…8; 1 is upright.
  int orientation = 1;
  AlphaKind alpha = AlphaKind::associated;
  /// Undone where the caller lets colour be automatic; the format decodes plain, linear values then.
  Curve curve = Curve::none;
  double gamma = 1;                         ///< of Curve::gamma
  std::optional<Chromaticities> primaries;  ///< of the linear values; none: BT.709, or unknown
  std::vector<std::byte> icc;               ///< an ICC profile, which then says all of colour
  std::string xmp;                          ///< an XMP packet
  std::shared_ptr<GainMap> gain_map;        ///< to be applied to linear colours
};

}  // namespace welkin::io
