#include "welkin/base/number_text.h"

#include <cmath>
#include <locale>
#include <sstream>

namespace welkin {

std::string number_text(double value) {
  std::string text;
  for (int digits = 6; digits <= 17; ++digits) {
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out.precision(digits);
    out << value;
    text = out.str();
    if (parse_number(text) == value) break;
  }
  return text;
}

std::optional<double> parse_number(std::string_view text) {
  std::istringstream in{std::string(text)};
  in.imbue(std::locale::classic());
  in >> std::noskipws;
  double value = 0;
  if (!(in >> value) || in.peek() != std::istringstream::traits_type::eof() || !std::isfinite(value))
    return std::nullopt;
  return value;
}

}  // namespace welkin
