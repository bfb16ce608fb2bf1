#pragma once

#include <string_view>

#include "welkin/base/export.h"

/// @file
/// Filters by name.
namespace welkin {

/// How a map is read between its texels.
enum class Filter {
  automatic,  ///< magnified: Lanczos, four lobes, 8×8 texels; minified: the mean over the solid angle of the
              ///< target's texel (docs/filtering.md)
  nearest,    ///< the texel that holds the position
  bilinear,   ///< 2×2 texels; aliases when minified, as do all below
  bicubic,    ///< Catmull–Rom, 4×4 texels
  lanczos,    ///< three lobes, 6×6 texels
};

/// `auto`, `nearest`, `bilinear`, `bicubic`, `lanczos`. Throws Error (bad_request) for another name.
WELKIN_API Filter filter_from_name(std::string_view name);
/// The name that filter_from_name takes.
WELKIN_API std::string_view name_of(Filter filter);

}  // namespace welkin
