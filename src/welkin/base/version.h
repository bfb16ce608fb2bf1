#pragma once

#include <string_view>

#include "welkin/base/export.h"

namespace welkin {

/// Of the library: `0.1.0`.
WELKIN_API std::string_view version();

}  // namespace welkin
