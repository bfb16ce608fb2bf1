#include "json_text.h"

#include <fmt/core.h>

namespace welkin::cli {

std::string json_text(const nlohmann::ordered_json& report) {
  return report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

void print_json_text(const nlohmann::ordered_json& report) {
  fmt::print("{}", json_text(report));
}

}  // namespace welkin::cli
