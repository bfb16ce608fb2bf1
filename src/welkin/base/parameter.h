#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "welkin/base/export.h"

namespace welkin {

/// A number that a parameterization or a lobe can be given: a field of view, a roughness.
struct Parameter {
  std::string name;
  double value = 0;
  double minimum = 0;
  double maximum = 0;
  std::string description;
};

/// Throws Error when the value, written as `text`, is NaN or out of the parameter's range. `owner`: what
/// takes it.
WELKIN_API void check_range(std::string_view owner, const Parameter& parameter, double value,
                            std::string_view text);

/// The one of `known` that `NAME=NUMBER` names, with its value set; `inf` is a number. Throws Error for what
/// isn't of that form, for a name that `known` lacks (the nearest is suggested), and for a number out of
/// range.
WELKIN_API Parameter parse_parameter(std::string_view owner, const std::vector<Parameter>& known,
                                     std::string_view assignment);

}  // namespace welkin
