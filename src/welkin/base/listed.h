#pragma once

#include <span>
#include <string>
#include <string_view>

namespace welkin {

/// `R G B`: the names in one text, with `between` between them.
inline std::string listed(std::span<const std::string> names, std::string_view between = " ") {
  std::string text;
  for (const std::string& name : names) {
    if (!text.empty()) text += between;
    text += name;
  }
  return text;
}

}  // namespace welkin
