#include "welkin/base/parameter.h"

#include <limits>
#include <optional>

#include "welkin/base/error.h"
#include "welkin/base/number_text.h"

namespace welkin {
namespace {

[[noreturn]] void refuse(std::string_view owner, const Parameter& parameter, std::string_view text) {
  throw Error(ErrorKind::bad_request, std::string(owner) + ": " + parameter.name + "=" + std::string(text) +
                                          " is not a number in " + number_text(parameter.minimum) + "…" +
                                          number_text(parameter.maximum) + " (" + parameter.description +
                                          ")");
}

}  // namespace

void check_range(std::string_view owner, const Parameter& parameter, double value, std::string_view text) {
  if (!(value >= parameter.minimum && value <= parameter.maximum)) refuse(owner, parameter, text);
}

Parameter parse_parameter(std::string_view owner, const std::vector<Parameter>& known,
                          std::string_view assignment) {
  const std::size_t equals = assignment.find('=');
  const std::string name(assignment.substr(0, equals)), who(owner);
  if (known.empty())
    throw Error(ErrorKind::bad_request, who + " takes no parameters, but '" + name + "' was given");
  std::vector<std::string> names;
  for (const Parameter& each : known) {
    names.push_back(each.name);
    if (each.name != name) continue;
    if (equals == std::string_view::npos)
      throw Error(ErrorKind::bad_request, who + ": write " + name + "=NUMBER");
    const std::string text(assignment.substr(equals + 1));
    const std::optional<double> value =
        text == "inf" ? std::numeric_limits<double>::infinity() : parse_number(text);
    if (!value) refuse(owner, each, text);
    check_range(owner, each, *value, text);
    Parameter parameter = each;
    parameter.value = *value;
    return parameter;
  }
  throw Error(ErrorKind::bad_request, unknown_name("parameter of " + who, name, names));
}

}  // namespace welkin
