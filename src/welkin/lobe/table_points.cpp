#include "welkin/lobe/table_points.h"

#include <algorithm>
#include <cmath>

#include "welkin/base/error.h"
#include "welkin/base/number_text.h"
#include "welkin/lobe/lobe.h"

namespace welkin::lobe {
namespace {

constexpr double kNarrowest = 1e-7;  // radians

}  // namespace

void check_point(const std::string& where, const std::vector<double>& before, double degrees, double value) {
  // Numbers are written out for an error alone: tables are long.
  const auto fail = [&](const std::string& what) { throw Error(ErrorKind::bad_request, where + what); };
  const auto angle = [&] { return ": the angle " + number_text(degrees) + "°"; };
  if (!(degrees >= 0 && degrees <= 180)) fail(angle() + " is not in 0…180°");
  if (before.empty() && degrees != 0) fail(": the first angle is " + number_text(degrees) + "°, not 0");
  if (!before.empty() && !(degrees > before.back())) {
    fail(angle() + " is not above the one before, " + number_text(before.back()) + "°");
  }
  if (!(value >= 0 && std::isfinite(value))) {
    fail(": the value " + number_text(value) + " is not a finite number of at least 0");
  }
  if (before.size() >= kMaxTablePoints) {
    fail(": has more than " + std::to_string(kMaxTablePoints) + " points");
  }
}

Table make_table(std::string_view name, std::span<const double> degrees, std::span<const double> values) {
  const std::string label(name);
  if (degrees.size() != values.size()) {
    throw Error(
        ErrorKind::bad_request, label,
        "has " + std::to_string(degrees.size()) + " angles for " + std::to_string(values.size()) + " values");
  }
  if (degrees.size() < 2) throw Error(ErrorKind::bad_request, label, "has fewer than two points");
  std::vector<double> checked;
  for (std::size_t i = 0; i < degrees.size(); ++i) {
    check_point(label + ": point " + std::to_string(i + 1), checked, degrees[i], values[i]);
    checked.push_back(degrees[i]);
  }
  const double largest = *std::max_element(values.begin(), values.end());
  if (largest == 0) throw Error(ErrorKind::bad_request, label, "all values are 0");
  Table table;
  table.angles.clear();
  table.values.clear();
  for (std::size_t i = 0; i < degrees.size(); ++i) {
    // 180/180 · π is π exactly, π/180 · 180 need not be.
    table.angles.push_back(degrees[i] / 180 * kPi);
    table.values.push_back(values[i] / largest);
  }
  if (table.width() < kNarrowest)
    throw Error(ErrorKind::bad_request, label, "is narrower than 1e-7 radians, as good as a mirror");
  return table;
}

}  // namespace welkin::lobe
