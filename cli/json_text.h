#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace welkin::cli {

/// Indented, and ended by a line; bytes that are not UTF-8 become replacement characters.
std::string json_text(const nlohmann::ordered_json& report);

/// The same on standard output.
void print_json_text(const nlohmann::ordered_json& report);

}  // namespace welkin::cli
