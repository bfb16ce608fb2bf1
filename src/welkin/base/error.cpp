#include "welkin/base/error.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace welkin {
namespace {

/// Levenshtein distance: the fewest insertions, deletions and replacements that turn a into b.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string_view name_of(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::not_found:
      return "not found";
    case ErrorKind::denied:
      return "denied";
    case ErrorKind::system:
      return "system";
    case ErrorKind::damaged:
      return "damaged";
    case ErrorKind::unsupported:
      return "unsupported";
    case ErrorKind::mismatch:
      return "mismatch";
    case ErrorKind::too_large:
      return "too large";
    case ErrorKind::bad_value:
      return "bad value";
    case ErrorKind::bad_request:
      return "bad request";
  }
  return "?";
}

Error::Error(ErrorKind kind, const std::string& cause) : std::runtime_error(cause), kind_(kind) {}

Error::Error(ErrorKind kind, const std::string& file, const std::string& cause)
    : std::runtime_error(file + ": " + cause), kind_(kind), file_(file) {}

std::string Error::cause() const {
  const std::string whole = what();
  return file_.empty() ? whole : whole.substr(file_.size() + 2);
}

// Here, so that the library holds the classes' type information.
Error::~Error() = default;
Cancelled::~Cancelled() = default;

Error in_file(const std::string& file, const Error& error) {
  return Error(error.kind(), file, error.what());
}

std::string unknown_name(std::string_view kind, std::string_view name, std::span<const std::string> known) {
  std::string message("unknown ");
  message.append(kind).append(" '").append(name).append("'");
  const auto nearest = std::min_element(known.begin(), known.end(), [&](const auto& a, const auto& b) {
    return edit_distance(name, a) < edit_distance(name, b);
  });
  if (nearest != known.end() && edit_distance(name, *nearest) <= std::max<std::size_t>(2, name.size() / 3)) {
    message.append("; did you mean '").append(*nearest).append("'?");
  }
  message += " (one of:";
  for (const auto& each : known) message.append(&each == known.data() ? " " : ", ").append(each);
  return message.append(")");
}

}  // namespace welkin
