#include "welkin/harmonics/coefficients_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>

#include "welkin/base/error.h"
#include "welkin/base/number_text.h"
#include "welkin/harmonics/coefficients_text.h"
#include "welkin/harmonics/json_values.h"
#include "welkin/sphere/convention.h"

namespace welkin::harmonics {
namespace {

constexpr std::size_t kMostBytes = std::size_t{64} << 20;
constexpr std::string_view kBlank = " \t\r\f\v";

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

/// `a, b,c`: without the blanks around.
std::vector<std::string_view> split(std::string_view text) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t comma = text.find(',');
    parts.push_back(trimmed(text.substr(0, comma)));
    if (comma == std::string_view::npos) return parts;
    text = text.substr(comma + 1);
  }
}

/// body(line, number) for each line.
template <class Body>
void for_each_line(std::string_view text, const Body& body) {
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = text.find('\n');
    body(trimmed(text.substr(0, end)), number);
    text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
  }
}

[[noreturn]] void fail_line(int number, const std::string& what) {
  throw Error(ErrorKind::damaged, "line " + std::to_string(number) + " " + what);
}

/// What is written as it is, between quotes.
void check_text(const std::string& what, const std::string& text) {
  const bool plain = std::all_of(text.begin(), text.end(), [](char c) {
    return static_cast<unsigned char>(c) >= 0x20 && c != '"' && c != '\\' && c != 0x7f;
  });
  if (!plain) throw Error(ErrorKind::damaged, what + " has quotes, backslashes or control characters");
}

CoefficientsFile from_json(std::string_view text) {
  const JsonValue root = parse_json(text);
  const auto fail = [](const std::string& what) { throw Error(ErrorKind::damaged, what); };
  const auto word = [&](std::string_view name, std::string& to) {
    const JsonValue* value = root.member(name);
    if (value == nullptr) return;
    if (value->kind != JsonValue::Kind::text) fail("its member `" + std::string(name) + "` is no text");
    to = value->text;
  };
  CoefficientsFile file;
  file.coefficients.basis = "orthonormal";
  word("basis", file.coefficients.basis);
  file.convention = basis_from_name(file.coefficients.basis).convention;
  word("convention", file.convention);
  word("of", file.of);
  const JsonValue* rows = root.member("coefficients");
  if (rows == nullptr || rows->kind != JsonValue::Kind::array || rows->elements.empty())
    fail("it has no `coefficients`, a list with one list of channels for each");
  for (const JsonValue& row : rows->elements) {
    if (row.kind != JsonValue::Kind::array || row.elements.empty() ||
        row.elements.size() != rows->elements[0].elements.size())
      fail("its `coefficients` are not lists of as many numbers each");
    for (const JsonValue& each : row.elements) {
      if (each.kind != JsonValue::Kind::number) fail("one of its `coefficients` is no number");
      file.coefficients.values.push_back(each.number);
    }
  }
  const std::size_t channels = rows->elements[0].elements.size();
  if (channels > kMostChannels) fail("its `coefficients` have over 64 channels");
  file.coefficients.channel_names = names_of(channels);
  if (const JsonValue* names = root.member("channels"); names != nullptr) {
    if (names->elements.size() != channels)
      fail("its `channels` are not as many as the numbers of a coefficient");
    for (std::size_t c = 0; c < channels; ++c) file.coefficients.channel_names[c] = names->elements[c].text;
  }
  std::optional<double> order;
  if (const JsonValue* value = root.member("order"); value != nullptr) {
    if (value->kind != JsonValue::Kind::number) fail("its `order` is no number");
    order = value->number;
  }
  set_degree(file.coefficients, rows->elements.size(), order);
  return file;
}

/// A line that begins with `#` has `name value` pairs, with commas between.
void read_notes(std::string_view line, CoefficientsFile& file, std::optional<double>& order) {
  for (const std::string_view part : split(line.substr(1))) {
    const std::size_t blank = part.find(' ');
    if (blank == std::string_view::npos) continue;
    const std::string_view name = part.substr(0, blank), value = trimmed(part.substr(blank));
    if (name == "order") order = parse_number(value);
    if (name == "basis") {
      file.coefficients.basis = value;
      file.convention = basis_from_name(value).convention;
    }
    if (name == "of") file.of = value;
    if (name == "convention") file.convention = value;
  }
}

CoefficientsFile from_csv(std::string_view text) {
  CoefficientsFile file;
  file.coefficients.basis = "orthonormal";
  std::optional<double> order;
  std::size_t keys = 0, rows = 0;
  for_each_line(text, [&](std::string_view line, int number) {
    if (line.empty()) return;
    if (line.front() == '#') return read_notes(line, file, order);
    const std::vector<std::string_view> parts = split(line);
    if (keys == 0) {
      keys = parts.size() > 2 && parts[0] == "l" && parts[1] == "m" ? 2 : parts[0] == "name" ? 1 : 0;
      if (keys == 0 || parts.size() == keys || parts.size() > keys + kMostChannels)
        fail_line(number, "is not the head `l,m,R,G,B` or `name,R,G,B` of a table of coefficients");
      for (std::size_t i = keys; i < parts.size(); ++i)
        file.coefficients.channel_names.emplace_back(parts[i]);
      return;
    }
    if (parts.size() != keys + file.coefficients.channel_names.size())
      fail_line(number, "does not have as many entries as the head");
    if (keys == 2) {
      const int l = static_cast<int>(std::sqrt(static_cast<double>(rows)));
      if (parse_number(parts[0]) != l || parse_number(parts[1]) != static_cast<int>(rows) - index_of(l, 0))
        fail_line(number, "is not of the degree and order whose turn it is");
    }
    for (std::size_t i = keys; i < parts.size(); ++i) {
      const auto value = parse_number(parts[i]);
      if (!value) fail_line(number, "has '" + std::string(parts[i].substr(0, 40)) + "', which is no number");
      file.coefficients.values.push_back(*value);
    }
    ++rows;
  });
  if (rows == 0) throw Error(ErrorKind::damaged, "it has no coefficients");
  set_degree(file.coefficients, rows, order);
  return file;
}

/// `(r, g, b); // L00, …`, a line each.
CoefficientsFile from_filament(std::string_view text) {
  CoefficientsFile file;
  file.coefficients.basis = "filament";
  file.coefficients.channel_names = names_of(3);
  std::size_t rows = 0;
  for_each_line(text, [&](std::string_view line, int number) {
    if (line.empty()) return;
    const std::size_t end = line.find(')');
    const std::vector<std::string_view> parts = line.front() == '(' && end != std::string_view::npos
                                                    ? split(line.substr(1, end - 1))
                                                    : std::vector<std::string_view>{};
    if (parts.size() != 3) fail_line(number, "is not of the form `(r, g, b); // L00`");
    for (const std::string_view part : parts) {
      const auto value = parse_number(part);
      if (!value) fail_line(number, "has '" + std::string(part.substr(0, 40)) + "', which is no number");
      file.coefficients.values.push_back(*value);
    }
    ++rows;
  });
  // cmgen writes as many bands as it is asked for; the basis has three.
  if (rows == 1 || rows == 4) file.coefficients.values.resize(27);
  set_degree(file.coefficients, rows == 1 || rows == 4 ? 9 : rows, std::nullopt);
  return file;
}

}  // namespace

std::vector<std::string> names_of(std::size_t channels) {
  return SphericalHarmonics(0, static_cast<int>(channels)).channel_names;
}

void set_degree(BasisCoefficients& coefficients, std::size_t rows, std::optional<double> order) {
  const Basis& basis = basis_from_name(coefficients.basis);
  const auto counted = [](std::size_t count) {
    return std::to_string(count) + (count == 1 ? " coefficient" : " coefficients");
  };
  if (!basis.rows.empty()) {
    if (rows != basis.rows.size())
      throw Error(ErrorKind::mismatch, "it has " + counted(rows) + "; basis " + basis.name + " has " +
                                           std::to_string(basis.rows.size()));
    coefficients.degree = basis.degree;
    return;
  }
  const double degree = std::round(std::sqrt(static_cast<double>(rows))) - 1;
  if (order && (*order != std::floor(*order) || *order < 0))
    throw Error(ErrorKind::damaged, "its order is not a whole number of at least 0");
  if (std::max(degree, order.value_or(0)) > kMaxDegree)
    throw Error(ErrorKind::too_large, "its order is over " + std::to_string(kMaxDegree));
  const std::size_t expected = static_cast<std::size_t>(count_of(static_cast<int>(order.value_or(degree))));
  if (rows != expected)
    throw Error(ErrorKind::mismatch, order
                                         ? "it has " + counted(rows) + "; order " + number_text(*order) +
                                               " has " + std::to_string(expected)
                                         : "it has " + counted(rows) + ", which no order has: 1, 4, 9, 16…");
  coefficients.degree = static_cast<int>(degree);
}

CoefficientsFile parse_coefficients(std::string_view text, const std::string& name) {
  try {
    if (text.size() > kMostBytes)
      throw Error(ErrorKind::too_large, "is over 64 MiB, more than coefficients may have");
    if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    const char begin = first == std::string_view::npos ? '\0' : text[first];
    CoefficientsFile file = begin == '{'   ? from_json(text)
                            : begin == '(' ? from_filament(text)
                                           : from_csv(text);
    for (const double value : file.coefficients.values) {
      if (!std::isfinite(value)) throw Error(ErrorKind::bad_value, "a coefficient is not finite");
    }
    convention_from_name(file.convention);
    check_text("`of`", file.of);
    for (const std::string& channel : file.coefficients.channel_names) {
      check_text("the name of a channel", channel);
      if (channel.find(',') != std::string::npos)
        throw Error(ErrorKind::damaged, "the name of a channel has a comma");
    }
    return file;
  } catch (const Error& error) {
    throw in_file(name, error);
  }
}

CoefficientsFile read_coefficients(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in)
    throw Error(errno == EACCES   ? ErrorKind::denied
                : errno == ENOENT ? ErrorKind::not_found
                                  : ErrorKind::system,
                path, "cannot be opened");
  std::string text;
  std::array<char, 65536> part;
  while (text.size() <= kMostBytes && (in.read(part.data(), part.size()) || in.gcount() > 0))
    text.append(part.data(), static_cast<std::size_t>(in.gcount()));
  if (in.bad()) throw Error(ErrorKind::system, path, "cannot be read");
  return parse_coefficients(text, path);
}

SphericalHarmonics harmonics_of(const CoefficientsFile& file) {
  return from_basis(file.coefficients, convention_from_name(file.convention).lookup);
}

}  // namespace welkin::harmonics
