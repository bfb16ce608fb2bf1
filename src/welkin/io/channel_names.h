#pragma once

#include <string>
#include <string_view>

/// What channels hold by their names, which files spell differently.
namespace welkin::io {

/// `R`, `G`, `B`, `A`, `Y`, `X` or `Z` by what stands behind the last dot: `diffuse.R`, `r` and `Red` are
/// `R`, `luminance` is `Y`, `depth` is `Z`. Empty for other names.
std::string_view meaning_of_channel(std::string_view name);

/// What stands before the last dot, the channel's layer; empty without one.
std::string_view layer_of_channel(std::string_view name);

}  // namespace welkin::io
