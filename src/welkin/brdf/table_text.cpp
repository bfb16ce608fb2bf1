#include "welkin/brdf/table_text.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "welkin/base/error.h"

namespace welkin::brdf {
namespace {

bool is_identifier(std::string_view name) {
  const auto letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; };
  return !name.empty() && letter(name.front()) && std::all_of(name.begin(), name.end(), [&](char c) {
    return letter(c) || std::isdigit(static_cast<unsigned char>(c)) != 0;
  });
}

/// The shortest that reads back as the same float, with what makes it one in C.
std::string literal(float value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  std::string text(buffer, end);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text + "f";
}

}  // namespace

std::string c_header(ImageView<const float> table, std::string_view name, std::string_view comment) {
  if (!is_identifier(name))
    throw Error(ErrorKind::bad_request, "'" + std::string(name) + "' is no name for an array in C");
  require(table.width > 0 && table.height > 0 && table.channels > 0, "a table without texels");
  std::string capitals;
  for (const char c : name) capitals += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));

  std::string text;
  while (!comment.empty()) {
    const std::size_t end = std::min(comment.find('\n'), comment.size());
    text += "// " + std::string(comment.substr(0, end)) + "\n";
    comment.remove_prefix(std::min(end + 1, comment.size()));
  }
  text += "#ifndef " + capitals + "_H\n#define " + capitals + "_H\n\n";
  const auto define = [&](const char* what, int value) {
    text += "#define " + capitals + "_" + what + " " + std::to_string(value) + "\n";
  };
  define("WIDTH", table.width);
  define("HEIGHT", table.height);
  define("CHANNELS", table.channels);
  const auto count = static_cast<long long>(table.width) * table.height * table.channels;
  text += "\nstatic const float " + std::string(name) + "[" + std::to_string(count) + "] = {\n";
  constexpr int kValuesPerLine = 8;
  for (int y = 0; y < table.height; ++y) {
    const int values = table.width * table.channels;
    for (int i = 0; i < values; ++i) {
      const float value = table.row(y)[i];
      if (!std::isfinite(value)) throw Error(ErrorKind::bad_value, "a table with values that aren't finite");
      text += i % kValuesPerLine == 0 ? "  " : " ";
      text += literal(value) + ",";
      if (i % kValuesPerLine == kValuesPerLine - 1 || i == values - 1) text += "\n";
    }
  }
  return text + "};\n\n#endif\n";
}

}  // namespace welkin::brdf
