#pragma once

#include <string>
#include <string_view>

#include "welkin/base/export.h"
#include "welkin/image/image.h"

/// @file
/// Tables as source code.
namespace welkin::brdf {

/// A C header that defines `static const float NAME[]`, row by row from the top left, channels interleaved,
/// and `NAME_WIDTH`, `NAME_HEIGHT` and `NAME_CHANNELS`, in capitals. Values read back as the same floats.
/// Each line of `comment` becomes one of the header's. Throws Error (bad_request) for a name that is no
/// identifier, an image without pixels, and for values that are not finite (bad_value).
WELKIN_API std::string c_header(ImageView<const float> table, std::string_view name,
                                std::string_view comment = {});

}  // namespace welkin::brdf
