#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "welkin/base/export.h"

/// @file
/// Radiance in the four 8-bit values of an ordinary picture.
namespace welkin::io {

struct WriteReport;

/// How radiance lies in the R G B A of pictures of 8 bits, which don't say so themselves (docs/formats.md).
/// With r, g, b and a the stored values over 255, the radiance c of a channel is
///
/// | name | radiance | largest | source |
/// |---|---|---|---|
/// | `rgbm,range=R` | R·a·r | R, 6 by default | Karis 2009, "RGBM color encoding" |
/// | `rgbd` | r^2.2 / a | 255 | Babylon.js, `helperFunctions.fx`, `fromRGBD` |
/// | `rgbp` | (r·(8 − 7a))² | 64 | PlayCanvas, `decode.js`, `decodeRGBP` |
/// | `rgbe` | 255·r·2^(255·a − 136) | 4.3e38 | Ward 1991, "Real Pixels" |
struct WELKIN_API LightEncoding {
  /// Which of them.
  enum class Kind {
    rgbm,  ///< a common multiplier
    rgbd,  ///< a common divisor, and a power
    rgbp,  ///< a common multiplier of square roots
    rgbe,  ///< a common exponent
  };
  Kind kind = Kind::rgbd;  ///< which
  double range = 6;        ///< of `rgbm`: its largest value

  /// `rgbd`, `rgbm,range=8`. Throws Error (bad_request) for unknown names and for a range of others, or that
  /// is not in 1 … 65504.
  static LightEncoding from_name(std::string_view text);
  /// What from_name takes to get this one again.
  std::string text() const;
  /// The largest radiance.
  double largest() const;

  /// `count` pixels R G B A to as many R G B.
  void decode(const std::uint8_t* rgba, std::size_t count, float* rgb) const;
  /// `count` pixels R G B, `stride` floats apart, to as many R G B A: each value to a nearest one of those
  /// that a pixel's common value allows, the common value to the one with the smallest steps. Negative values
  /// become 0, those beyond the largest are clipped, NaN becomes 0: counted in the report, with the error.
  void encode(const float* rgb, std::size_t stride, std::size_t count, std::uint8_t* rgba,
              WriteReport& report) const;
};

/// The names: rgbm, rgbd, rgbp, rgbe.
WELKIN_API std::vector<std::string> light_encoding_names();

}  // namespace welkin::io
