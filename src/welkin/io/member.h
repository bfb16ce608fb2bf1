#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>

/// Members of JSON that other programs wrote.
namespace welkin::io {

/// The member, or null where it or the object is missing.
inline const nlohmann::ordered_json& member(const nlohmann::ordered_json& object, const char* name) {
  static const nlohmann::ordered_json none;
  const auto found = object.is_object() ? object.find(name) : object.end();
  return found == object.end() ? none : *found;
}

/// All members that are texts, of an object; of anything else none.
inline std::map<std::string, std::string> text_members(const nlohmann::ordered_json& object) {
  std::map<std::string, std::string> texts;
  if (!object.is_object()) return texts;
  for (const auto& [key, value] : object.items()) {
    if (value.is_string()) texts[key] = value.get<std::string>();
  }
  return texts;
}

}  // namespace welkin::io
