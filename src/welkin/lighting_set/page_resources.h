#pragma once

#include <string_view>

/// The files of page/, as CMake compiles them in. Internal to lighting_set.
namespace welkin::lighting_set {

extern const std::string_view kPageStyle;
extern const std::string_view kPageViewer;

}  // namespace welkin::lighting_set
