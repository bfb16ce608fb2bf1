#include "hints.h"

#include <string_view>
#include <utility>

namespace welkin::cli {

std::string with_option(std::string message) {
  constexpr std::pair<std::string_view, std::string_view> kOptions[] = {
      {"another layer can be named", "--layer"},
      {"another part can be named", "--part"},
      {"other channels can be named", "--channels"},
      {"read one channel or three", "--channels"}};
  for (const auto& [proposal, option] : kOptions) {
    if (const std::size_t at = message.find(proposal); at != std::string::npos)
      return message.insert(at + proposal.size(), " (" + std::string(option) + ")");
  }
  return message;
}

}  // namespace welkin::cli
