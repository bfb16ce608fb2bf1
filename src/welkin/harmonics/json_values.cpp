#include "welkin/harmonics/json_values.h"

#include <algorithm>

#include "welkin/base/error.h"
#include "welkin/base/number_text.h"

namespace welkin::harmonics {
namespace {

constexpr int kDeepest = 32;

class Parser {
 public:
  explicit Parser(std::string_view text) : text_(text) {}

  JsonValue document() {
    JsonValue result = value(0);
    skip_blanks();
    if (at_ < text_.size()) fail("goes on after its value");
    return result;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw Error(ErrorKind::damaged, "is not JSON: " + what + " (byte " + std::to_string(at_) + ")");
  }
  void skip_blanks() {
    while (at_ < text_.size() && std::string_view(" \t\r\n").find(text_[at_]) != std::string_view::npos)
      ++at_;
  }
  char next() {
    skip_blanks();
    if (at_ >= text_.size()) fail("ends early");
    return text_[at_];
  }
  void expect(char c) {
    if (next() != c) fail(std::string("'") + c + "' is missing");
    ++at_;
  }

  JsonValue value(int depth) {
    if (depth > kDeepest) fail("is nested too deeply");
    JsonValue result;
    switch (next()) {
      case '{':
        result.kind = JsonValue::Kind::object;
        list('}', [&] {
          if (next() != '"') fail("a name is missing");
          std::string name = quoted();
          expect(':');
          result.members.insert_or_assign(std::move(name), value(depth + 1));
        });
        return result;
      case '[':
        result.kind = JsonValue::Kind::array;
        list(']', [&] { result.elements.push_back(value(depth + 1)); });
        return result;
      case '"':
        result.kind = JsonValue::Kind::text;
        result.text = quoted();
        return result;
      default:
        return word();
    }
  }

  /// What stands between brackets, with commas between.
  template <class Element>
  void list(char end, const Element& element) {
    ++at_;
    if (next() == end) {
      ++at_;
      return;
    }
    for (;;) {
      element();
      const char c = next();
      ++at_;
      if (c == end) return;
      if (c != ',') {
        --at_;
        fail("a comma is missing");
      }
    }
  }

  /// Escapes stay as they are written: no name or text here has any.
  std::string quoted() {
    const std::size_t first = ++at_;
    while (at_ < text_.size() && text_[at_] != '"') at_ += text_[at_] == '\\' ? 2u : 1u;
    if (at_ >= text_.size()) fail("a text has no end");
    return std::string(text_.substr(first, at_++ - first));
  }

  JsonValue word() {
    const std::size_t end = std::min(text_.find_first_of(" \t\r\n,]}:", at_), text_.size());
    const std::string_view found = text_.substr(at_, end - at_);
    JsonValue result;
    if (found == "true" || found == "false") {
      result.kind = JsonValue::Kind::boolean;
      result.number = found == "true" ? 1 : 0;
    } else if (found != "null") {
      const auto number = parse_number(found);
      if (!number) fail("'" + std::string(found.substr(0, 40)) + "' is no value");
      result.kind = JsonValue::Kind::number;
      result.number = *number;
    }
    at_ = end;
    return result;
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace

const JsonValue* JsonValue::member(std::string_view name) const {
  const auto found = members.find(name);
  return found == members.end() ? nullptr : &found->second;
}

JsonValue parse_json(std::string_view text) {
  return Parser(text).document();
}

}  // namespace welkin::harmonics
