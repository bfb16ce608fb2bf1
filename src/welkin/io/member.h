#pragma once

#include <map>
#include <string>

/// Members of JSON that other programs wrote: of nlohmann's values, which headers don't include. Internal to
/// io.
namespace welkin::io {

/// The member, or null where it or the object is missing.
template <class Json>
const Json& member(const Json& object, const char* name) {
  static const Json none;
  const auto found = object.is_object() ? object.find(name) : object.end();
  return found == object.end() ? none : *found;
}

/// All members that are texts, of an object; of anything else none.
template <class Json>
std::map<std::string, std::string> text_members(const Json& object) {
  std::map<std::string, std::string> texts;
  if (!object.is_object()) return texts;
  for (const auto& [key, value] : object.items()) {
    if (value.is_string()) texts[key] = value.template get<std::string>();
  }
  return texts;
}

}  // namespace welkin::io
