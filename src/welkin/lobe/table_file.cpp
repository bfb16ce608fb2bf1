#include "welkin/lobe/table_file.h"

#include <cerrno>
#include <fstream>
#include <iterator>
#include <optional>
#include <string_view>

#include "welkin/base/error.h"
#include "welkin/base/number_text.h"
#include "welkin/lobe/lobe.h"
#include "welkin/lobe/table_points.h"

namespace welkin::lobe {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{1} << 20;
constexpr std::string_view kBlank = " \t\r\f\v";

std::string read_text(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in)
    throw Error(errno == EACCES   ? ErrorKind::denied
                : errno == ENOENT ? ErrorKind::not_found
                                  : ErrorKind::system,
                path, "cannot be opened");
  std::string text(kMaxBytes + 1, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (in.bad()) throw Error(ErrorKind::system, path, "cannot be read");
  text.resize(static_cast<std::size_t>(in.gcount()));
  if (text.size() > kMaxBytes)
    throw Error(ErrorKind::too_large, path, "is over 1 MiB, more than a table of a lobe may have");
  return text;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

/// Two numbers with blanks, or one comma, between them.
std::optional<std::pair<double, double>> parse_pair(std::string_view line) {
  const std::size_t end = line.find_first_of(" \t,");
  if (end == std::string_view::npos) return std::nullopt;
  std::string_view rest = trimmed(line.substr(end));
  if (!rest.empty() && rest.front() == ',') rest = trimmed(rest.substr(1));
  const std::optional<double> angle = parse_number(line.substr(0, end)), value = parse_number(rest);
  if (!angle || !value) return std::nullopt;
  return std::pair{*angle, *value};
}

}  // namespace

TablePoints read_table_file(const std::string& path) {
  const std::string text = read_text(path);
  std::string_view rest = text;
  if (rest.substr(0, 3) == "\xEF\xBB\xBF") rest.remove_prefix(3);
  TablePoints points;
  for (int line = 1; !rest.empty(); ++line) {
    const std::size_t end = rest.find('\n');
    const std::string_view whole = rest.substr(0, end);
    rest = end == std::string_view::npos ? std::string_view{} : rest.substr(end + 1);
    const std::string_view content = trimmed(whole.substr(0, whole.find('#')));
    if (content.empty()) continue;
    const std::string where = path + ": line " + std::to_string(line);
    const auto pair = parse_pair(content);
    if (!pair) throw Error(ErrorKind::damaged, where, "is not an angle and a value");
    check_point(where, points.degrees, pair->first, pair->second);
    points.degrees.push_back(pair->first);
    points.values.push_back(pair->second);
  }
  return points;
}

}  // namespace welkin::lobe
