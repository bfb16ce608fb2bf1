#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "welkin/base/export.h"

/// @file
/// Numbers as text in files and options: a decimal point whatever the locale of the program says.
namespace welkin {

/// The shortest of 6 to 17 significant digits that reads back as the same number.
WELKIN_API std::string number_text(double value);

/// The whole of `text` as a number; none when it isn't one. `nan` and `inf` are not.
WELKIN_API std::optional<double> parse_number(std::string_view text);

}  // namespace welkin
