#pragma once

#include <string_view>

#include "welkin/base/export.h"

/// @file
/// The version of the library.
namespace welkin {

/// The version of the library that is linked: `0.1.0`.
WELKIN_API std::string_view version();

}  // namespace welkin
