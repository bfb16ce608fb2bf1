#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "welkin/base/export.h"

/// @file
/// Numbers that parameterizations and lobes take.
namespace welkin {

/// A number that a parameterization or a lobe can be given: a field of view, a roughness.
struct Parameter {
  std::string name;         ///< `fov`, `roughness`
  double value = 0;         ///< now
  double minimum = 0;       ///< the least that is allowed
  double maximum = 0;       ///< the largest that is allowed; may be infinite
  std::string description;  ///< one line, with its unit
};

/// Throws Error (bad_request) when the value, written as `text`, is NaN or out of the parameter's range.
/// `owner`, the name of what takes it, begins the message.
WELKIN_API void check_range(std::string_view owner, const Parameter& parameter, double value,
                            std::string_view text);

/// The one of `known` that the assignment `NAME=NUMBER` names, with its value set; `inf` is a number. Throws
/// Error (bad_request) for what isn't of that form, for a name that `known` lacks (the nearest is suggested),
/// and for a number out of range; `owner` as in check_range.
WELKIN_API Parameter parse_parameter(std::string_view owner, const std::vector<Parameter>& known,
                                     std::string_view assignment);

}  // namespace welkin
