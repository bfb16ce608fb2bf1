#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

/// As much of JSON (RFC 8259) as files of numbers need. Internal to harmonics.
namespace welkin::harmonics {

/// A value; members and elements as far as its kind has them.
struct JsonValue {
  enum class Kind { null, boolean, number, text, array, object };
  Kind kind = Kind::null;
  double number = 0;
  std::string text;
  std::vector<JsonValue> elements;
  std::map<std::string, JsonValue, std::less<>> members;

  /// Of an object; null when there is none.
  const JsonValue* member(std::string_view name) const;
};

/// Throws Error (damaged) with the byte at which it isn't JSON, or where values are nested over 32 deep.
JsonValue parse_json(std::string_view text);

}  // namespace welkin::harmonics
