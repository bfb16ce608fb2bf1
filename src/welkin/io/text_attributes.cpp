#include "welkin/io/text_attributes.h"

#include <algorithm>

#include "welkin/base/error.h"

namespace welkin::io {
namespace {

bool is_letter(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}

bool is_name(std::string_view text) {
  if (text.empty() || !is_letter(text.front()) || text.back() == ' ') return false;
  return std::all_of(text.begin(), text.end(), [](char c) {
    return is_letter(c) || (c >= '0' && c <= '9') ||
           std::string_view("_.:/- ").find(c) != std::string_view::npos;
  });
}

bool is_control(char c) {
  return static_cast<unsigned char>(c) < 32 || c == 127;
}

}  // namespace

void parse_attribute_lines(std::string_view text, const std::string& others,
                           std::map<std::string, std::string>& attributes) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    while (!line.empty() && (line.back() == '\r' || line.back() == '\0')) line.remove_suffix(1);
    if (line.empty()) continue;
    const std::size_t equals = line.find('=');
    if (equals != std::string_view::npos && is_name(line.substr(0, equals))) {
      attributes.emplace(line.substr(0, equals), line.substr(equals + 1));
    } else {
      std::string& rest = attributes[others];
      if (!rest.empty()) rest += '\n';
      rest += line;
    }
  }
}

std::string attribute_lines(const std::map<std::string, std::string>& attributes, const std::string& others) {
  std::string text;
  for (const auto& [name, value] : attributes) {
    if (name == others) continue;
    if (!is_name(name)) {
      throw Error(ErrorKind::unsupported,
                  "the attribute name '" + name + "' cannot be written as a line name=value");
    }
    text += name + "=";
    for (const char c : value) text += is_control(c) ? ' ' : c;
    text += '\n';
  }
  const auto rest = attributes.find(others);
  if (rest != attributes.end() && !rest->second.empty()) {
    // An empty line would end a .hdr header.
    char before = '\n';
    for (const char c : rest->second) {
      const char kept = c == '\n' || !is_control(c) ? c : ' ';
      if (kept != '\n' || before != '\n') text += kept;
      before = kept;
    }
    if (!text.empty() && text.back() != '\n') text += '\n';
  }
  return text;
}

}  // namespace welkin::io
