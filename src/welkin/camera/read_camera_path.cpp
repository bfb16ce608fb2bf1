#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "welkin/base/error.h"
#include "welkin/base/number_text.h"
#include "welkin/camera/camera_path.h"

namespace welkin {
namespace {

constexpr std::size_t kMostBytes = std::size_t{16} << 20;
constexpr std::array<std::string_view, 5> kColumns{"frame", "yaw", "pitch", "roll", "fov"};

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r";
  const std::size_t first = text.find_first_not_of(kSpace);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

/// Of what a file says, as much as fits a message.
std::string quoted(std::string_view text) {
  std::string shown(text.substr(0, 40));
  for (char& c : shown) c = static_cast<unsigned char>(c) < 0x20 ? '?' : c;
  return "'" + shown + "'";
}

void set(CameraKey& key, std::size_t column, double value) {
  double* const places[] = {&key.frame, &key.look.yaw, &key.look.pitch, &key.look.roll};
  if (column < 4) {
    *places[column] = value;
  } else {
    key.fov = value;
  }
}

std::size_t column_of(std::string_view name) {
  const auto at = std::find(kColumns.begin(), kColumns.end(), name);
  if (at == kColumns.end()) {
    const std::vector<std::string> known(kColumns.begin(), kColumns.end());
    throw Error(
        ErrorKind::damaged,
        unknown_name("column", quoted(name).substr(1, std::min<std::size_t>(name.size(), 40)), known));
  }
  return static_cast<std::size_t>(at - kColumns.begin());
}

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  while (true) {
    const std::size_t comma = line.find(',');
    cells.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

std::vector<CameraKey> keys_of_table(std::string_view text) {
  std::vector<std::size_t> columns;
  std::vector<CameraKey> keys;
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = trimmed(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.empty() || line.front() == '#') continue;
    const auto fail = [&](const std::string& cause) {
      throw Error(ErrorKind::damaged, "line " + std::to_string(number) + ": " + cause);
    };
    const std::vector<std::string_view> cells = cells_of(line);
    if (columns.empty()) {
      for (const std::string_view cell : cells) {
        const std::size_t column = column_of(cell);
        if (std::count(columns.begin(), columns.end(), column) > 0)
          fail("two columns are called " + std::string(cell));
        columns.push_back(column);
      }
      if (std::count(columns.begin(), columns.end(), 0U) == 0) fail("no column is called frame");
      continue;
    }
    if (cells.size() != columns.size())
      fail(std::to_string(cells.size()) + " values, where the first line names " +
           std::to_string(columns.size()) + " columns");
    CameraKey key;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const std::optional<double> value = parse_number(cells[i]);
      if (!value) fail(quoted(cells[i]) + " is not a number");
      set(key, columns[i], *value);
    }
    keys.push_back(key);
  }
  return keys;
}

std::vector<CameraKey> keys_of_json(std::string_view text) {
  nlohmann::json list;
  try {
    list = nlohmann::json::parse(text);
  } catch (const nlohmann::json::exception& error) {
    throw Error(ErrorKind::damaged, "no valid JSON: " + std::string(error.what()));
  }
  std::vector<CameraKey> keys;
  for (const nlohmann::json& each : list) {
    const auto fail = [&](const std::string& cause) {
      throw Error(ErrorKind::damaged, "key " + std::to_string(keys.size() + 1) + ": " + cause);
    };
    if (!each.is_object()) fail("is no object");
    CameraKey key;
    for (const auto& [name, value] : each.items()) {
      const std::size_t column = column_of(name);
      if (!value.is_number()) fail(name + " is not a number");
      set(key, column, value.get<double>());
    }
    if (!each.contains("frame")) fail("has no frame");
    keys.push_back(key);
  }
  return keys;
}

}  // namespace

CameraPath parse_camera_path(std::string_view text, const std::string& name) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  try {
    if (first == std::string_view::npos) throw Error(ErrorKind::damaged, "is empty");
    return CameraPath(text[first] == '[' ? keys_of_json(text) : keys_of_table(text));
  } catch (const Error& error) {
    throw in_file(name, error);
  }
}

CameraPath read_camera_path(const std::filesystem::path& path) {
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  const auto failed = [&] {
    const int cause = errno;
    const ErrorKind kind = cause == ENOENT   ? ErrorKind::not_found
                           : cause == EACCES ? ErrorKind::denied
                                             : ErrorKind::system;
    throw Error(kind, path.string(), cause != 0 ? std::strerror(cause) : "cannot be read");
  };
  if (!file) failed();
  std::string text;
  std::vector<char> block(1 << 16);
  while (file.read(block.data(), static_cast<std::streamsize>(block.size())), file.gcount() > 0) {
    text.append(block.data(), static_cast<std::size_t>(file.gcount()));
    if (text.size() > kMostBytes)
      throw Error(ErrorKind::too_large, path.string(), "is over 16 MiB, too much for key frames");
  }
  if (file.bad()) failed();
  return parse_camera_path(text, path.string());
}

}  // namespace welkin
