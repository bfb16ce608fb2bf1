#pragma once

#include <filesystem>
#include <string>

#include "welkin/base/number_text.h"
#include "welkin/map/layout.h"

/// What reading and writing map files share. Internal to these two.
namespace welkin::map_file {

// Text metadata of a map's file.
inline constexpr const char* kShapeKey = "welkin.parameterization";
inline constexpr const char* kFacesKey = "welkin.faces";
inline constexpr const char* kChartKey = "welkin.chart";
inline constexpr const char* kOrientationKey = "welkin.orientation";
inline constexpr const char* kBorderKey = "welkin.border";

/// The file of one chart: `%s` replaced by the chart's name.
inline std::filesystem::path chart_path(const std::filesystem::path& pattern, const std::string& chart) {
  std::string text = pattern.string();
  text.replace(text.find("%s"), 2, chart);
  return text;
}

inline bool is_pattern(const std::filesystem::path& path) {
  return path.string().find("%s") != std::string::npos;
}

inline std::string text_of(const Matrix3& m) {
  std::string text;
  for (const auto& row : m.rows) {
    for (double value : row) {
      text += (text.empty() ? "" : " ") + number_text(value);
    }
  }
  return text;
}

inline std::string text_of(ChartSize size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

inline Layout layout_for(const Layout& layout, const sphere::AnyParameterization& p,
                         const Matrix3& orientation) {
  return determinant(orientation) < 0 ? for_reflected_world(layout, p) : layout;
}

}  // namespace welkin::map_file
