#include "welkin/brdf/measured.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "welkin/base/error.h"
#include "welkin/base/number_text.h"
#include "welkin/brdf/file_bytes.h"
#include "welkin/math/angles.h"

namespace welkin::brdf {
namespace {

constexpr std::uint64_t kMaxBytes = std::uint64_t{256} << 20;

std::string degrees_text(double degrees) {
  return number_text(degrees) + "°";
}

/// Which two of ascending `angles` an angle is between, and how far from the first to the second.
struct Position {
  std::size_t below;
  double part;
};

Position position_in(const std::vector<double>& angles, double angle) {
  if (angles.size() == 1 || angle >= angles.back()) return {angles.size() - 1, 0};
  const auto above = std::upper_bound(angles.begin() + 1, angles.end() - 1, angle);
  const auto below = static_cast<std::size_t>(above - angles.begin()) - 1;
  return {below, std::max(0.0, (angle - angles[below]) / (angles[below + 1] - angles[below]))};
}

class Measured final : public AnyBrdf::Model {
 public:
  Measured(std::string origin, MeasuredGrid grid) : origin_(std::move(origin)), grid_(std::move(grid)) {}

  std::string name() const override { return "table"; }
  std::string description() const override { return "measured: a file of angles and values"; }
  std::string source() const override { return "the table"; }
  std::string origin() const override { return origin_; }

  std::vector<std::string> notes() const override {
    std::vector<std::string> list;
    const auto held = [&](const char* what, double last) {
      if (last < 90)
        list.push_back(std::string(what) + " beyond " + degrees_text(last) + " are not in the table: as at " +
                       degrees_text(last));
    };
    held("angles of light", grid_.light.back());
    held("angles of view", grid_.view.back());
    return list;
  }

  double value(const Vec3d& view, const Vec3d& light) const override {
    const double across = light.x * view.y - light.y * view.x, along = light.x * view.x + light.y * view.y;
    const Position i = position_in(grid_.light, angle_of(light)), o = position_in(grid_.view, angle_of(view)),
                   d = position_in(grid_.between, std::atan2(std::fabs(across), along) / kDegree);
    const auto mix = [](double a, double b, double part) { return part > 0 ? a + part * (b - a) : a; };
    const auto along_between = [&](std::size_t at_i, std::size_t at_o) {
      const double* row = &grid_.values[(at_i * grid_.view.size() + at_o) * grid_.between.size()];
      return mix(row[d.below], d.part > 0 ? row[d.below + 1] : 0, d.part);
    };
    const auto along_view = [&](std::size_t at_i) {
      return mix(along_between(at_i, o.below), o.part > 0 ? along_between(at_i, o.below + 1) : 0, o.part);
    };
    return mix(along_view(i.below), i.part > 0 ? along_view(i.below + 1) : 0, i.part);
  }

  /// The finest step, which is as narrow as a feature can be.
  double width() const override {
    double finest = 90;
    for (const auto* angles : {&grid_.light, &grid_.view}) {
      for (std::size_t k = 1; k < angles->size(); ++k)
        finest = std::min(finest, (*angles)[k] - (*angles)[k - 1]);
    }
    return std::max(finest * kDegree, 1e-4);
  }

 private:
  static double angle_of(const Vec3d& d) { return std::atan2(std::hypot(d.x, d.y), d.z) / kDegree; }

  std::string origin_;
  MeasuredGrid grid_;
};

void check_angles(const std::string& label, const char* name, const std::vector<double>& angles,
                  double last) {
  const auto fail = [&](const std::string& what) { throw Error(ErrorKind::bad_request, label, what); };
  if (angles.empty()) fail(std::string("has no angles ") + name);
  for (std::size_t k = 0; k < angles.size(); ++k) {
    if (!(angles[k] >= 0 && angles[k] <= last))
      fail(std::string(name) + " " + degrees_text(angles[k]) + " is not in 0…" + degrees_text(last));
    if (k > 0 && !(angles[k] > angles[k - 1])) fail(std::string("the angles ") + name + " don't ascend");
  }
  if (angles.front() > 0)
    fail("has a gap: no value for " + std::string(name) + " below " + degrees_text(angles.front()));
}

/// A line of the file.
struct Row {
  std::array<double, 4> numbers;
  int line;
};

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r\f\v";
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

/// Four numbers with blanks, or one comma, between them.
std::optional<std::array<double, 4>> parse_four(std::string_view line) {
  std::array<double, 4> numbers{};
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t end = line.find_first_of(" \t,");
    const std::optional<double> number = parse_number(line.substr(0, end));
    if (!number) return std::nullopt;
    numbers[k] = *number;
    line = end == std::string_view::npos ? std::string_view{} : trimmed(line.substr(end));
    if (!line.empty() && line.front() == ',') line = trimmed(line.substr(1));
  }
  if (!line.empty()) return std::nullopt;
  return numbers;
}

std::vector<Row> read_rows(const std::string& path) {
  const std::string text = file_bytes(path, kMaxBytes, "more than a table of a BRDF may have");
  std::string_view rest = text;
  if (rest.substr(0, 3) == "\xEF\xBB\xBF") rest.remove_prefix(3);
  std::vector<Row> rows;
  bool may_be_header = true;
  for (int line = 1; !rest.empty(); ++line) {
    const std::size_t end = rest.find('\n');
    const std::string_view whole = rest.substr(0, end);
    rest = end == std::string_view::npos ? std::string_view{} : rest.substr(end + 1);
    const std::string_view content = trimmed(whole.substr(0, whole.find('#')));
    if (content.empty()) continue;
    const auto numbers = parse_four(content);
    const std::string where = path + ": line " + std::to_string(line);
    if (!numbers) {
      // `nan` isn't a header.
      const bool names = may_be_header && content.find_first_of("0123456789") == std::string_view::npos;
      if (!names) throw Error(ErrorKind::damaged, where, "is not three angles and a value");
      may_be_header = false;
      continue;
    }
    may_be_header = false;
    const auto& [light, view, between, value] = *numbers;
    if (!(light >= 0 && light <= 90 && view >= 0 && view <= 90))
      throw Error(ErrorKind::bad_request, where, "angles from the normal are in 0…90°");
    if (!(between >= 0 && between <= 180))
      throw Error(ErrorKind::bad_request, where,
                  "Δφ " + degrees_text(between) + " is not in 0…180°: an isotropic BRDF is symmetric");
    if (!(value >= 0))
      throw Error(ErrorKind::bad_value, where, "the value " + number_text(value) + " is negative");
    rows.push_back({*numbers, line});
  }
  if (rows.empty()) throw Error(ErrorKind::damaged, path, "has no values");
  return rows;
}

std::vector<double> angles_of(const std::vector<Row>& rows, std::size_t column) {
  std::vector<double> angles;
  for (const Row& row : rows) angles.push_back(row.numbers[column]);
  std::sort(angles.begin(), angles.end());
  angles.erase(std::unique(angles.begin(), angles.end()), angles.end());
  return angles;
}

}  // namespace

std::shared_ptr<const AnyBrdf::Model> measured_model(const std::string& label, const std::string& origin,
                                                     MeasuredGrid grid) {
  check_angles(label, "θi", grid.light, 90);
  check_angles(label, "θr", grid.view, 90);
  check_angles(label, "Δφ", grid.between, 180);
  if (grid.between.size() > 1 && grid.between.back() < 180)
    throw Error(ErrorKind::bad_request, label,
                "has a gap: no value for Δφ above " + degrees_text(grid.between.back()));
  if (grid.values.size() != grid.light.size() * grid.view.size() * grid.between.size())
    throw Error(ErrorKind::mismatch, label,
                "has " + std::to_string(grid.values.size()) + " values for " +
                    std::to_string(grid.light.size()) + " × " + std::to_string(grid.view.size()) + " × " +
                    std::to_string(grid.between.size()) + " angles");
  double largest = 0;
  for (const double value : grid.values) {
    if (!(value >= 0 && std::isfinite(value)))
      throw Error(ErrorKind::bad_value, label,
                  "the value " + number_text(value) + " is not a finite number of at least 0");
    largest = std::max(largest, value);
  }
  if (largest == 0) throw Error(ErrorKind::bad_value, label, "all values are 0");
  return std::make_shared<Measured>(origin, std::move(grid));
}

std::shared_ptr<const AnyBrdf::Model> read_measured(const std::string& path, const std::string& origin) {
  const std::vector<Row> rows = read_rows(path);
  MeasuredGrid grid{angles_of(rows, 0), angles_of(rows, 1), angles_of(rows, 2), {}};
  const double combinations = static_cast<double>(grid.light.size()) * static_cast<double>(grid.view.size()) *
                              static_cast<double>(grid.between.size());
  const auto where_of = [&](std::size_t index) {
    const std::size_t d = index % grid.between.size(), o = index / grid.between.size() % grid.view.size(),
                      i = index / grid.between.size() / grid.view.size();
    return "θi " + degrees_text(grid.light[i]) + ", θr " + degrees_text(grid.view[o]) + ", Δφ " +
           degrees_text(grid.between[d]);
  };
  // Angles that never repeat would make a grid of the cube of their number.
  if (combinations > 8 * static_cast<double>(rows.size()) + 64)
    throw Error(ErrorKind::bad_request, path,
                "has gaps: " + std::to_string(rows.size()) + " values for " +
                    std::to_string(grid.light.size()) + " × " + std::to_string(grid.view.size()) + " × " +
                    std::to_string(grid.between.size()) + " angles, which must form a grid");
  std::vector<int> line_of(static_cast<std::size_t>(combinations), 0);
  grid.values.resize(line_of.size());
  const auto index_in = [](const std::vector<double>& angles, double angle) {
    return static_cast<std::size_t>(std::lower_bound(angles.begin(), angles.end(), angle) - angles.begin());
  };
  for (const Row& row : rows) {
    const auto& [light, view, between, value] = row.numbers;
    const std::size_t index =
        (index_in(grid.light, light) * grid.view.size() + index_in(grid.view, view)) * grid.between.size() +
        index_in(grid.between, between);
    if (line_of[index] != 0)
      throw Error(ErrorKind::bad_request, path + ": line " + std::to_string(row.line),
                  "has " + where_of(index) + " again, after line " + std::to_string(line_of[index]));
    line_of[index] = row.line;
    grid.values[index] = value;
  }
  const auto missing = std::find(line_of.begin(), line_of.end(), 0);
  if (missing != line_of.end()) {
    throw Error(ErrorKind::bad_request, path,
                "has a gap: no value for " + where_of(static_cast<std::size_t>(missing - line_of.begin())) +
                    " (" + std::to_string(std::count(line_of.begin(), line_of.end(), 0)) +
                    " are missing of " + std::to_string(line_of.size()) + ")");
  }
  return measured_model(path, origin, std::move(grid));
}

}  // namespace welkin::brdf
