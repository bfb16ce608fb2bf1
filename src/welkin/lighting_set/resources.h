#pragma once

#include <string>
#include <string_view>

/// The files of page/ and snippets/, as CMake compiles them in. Internal to lighting_set.
namespace welkin::lighting_set {

extern const std::string_view kPageStyle;
extern const std::string_view kPageViewer;

/// The code that loads a set: a file of snippets/, by its name.
std::string snippet(std::string_view file);

}  // namespace welkin::lighting_set
