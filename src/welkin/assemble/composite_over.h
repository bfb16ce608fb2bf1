#pragma once

#include "welkin/base/export.h"
#include "welkin/image/image.h"

/// @file
/// Pictures over pictures.
namespace welkin {

/// How the colours of a picture with alpha are stored.
enum class Association {
  premultiplied,  ///< multiplied by alpha, as OpenEXR has them and reading makes them
  straight,       ///< as they would be where alpha is 1
};

/// Lays a near picture over a far one, as rendered objects over a view of the world behind them (Porter &
/// Duff 1984, "over"): far ← near + (1 − alpha) · far, in linear light. `near` has R G B A; its colours are
/// premultiplied unless it says otherwise, and may be light without alpha, as flames are. `far` has R G B, or
/// R G B A premultiplied, whose alpha becomes that of both. Throws Error: (mismatch) pictures of other sizes,
/// (bad_request) of other channels, (bad_value) alpha that isn't 0 … 1 (within 0.001, for who filtered it),
/// colours of the near picture that aren't finite; then `far` is as it was.
WELKIN_API void composite_over(ImageView<const float> near, ImageView<float> far,
                               Association association = Association::premultiplied);

}  // namespace welkin
