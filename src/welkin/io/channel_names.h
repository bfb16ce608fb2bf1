#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// What channels hold by their names, which files spell differently.
namespace welkin::io {

/// The attribute that names a map's channels, `R,G,B`, where its file's format may have added others.
inline constexpr const char* kChannelsKey = "welkin.channels";

/// Whether a file's attributes say that its A is 1 because the map had none.
bool is_alpha_added(const std::map<std::string, std::string>& attributes);

/// `R`, `G`, `B`, `A`, `Y`, `X` or `Z` by what stands behind the last dot: `diffuse.R`, `r` and `Red` are
/// `R`, `luminance` is `Y`, `depth` is `Z`. Empty for other names.
std::string_view meaning_of_channel(std::string_view name);

/// What stands before the last dot, the channel's layer; empty without one.
std::string_view layer_of_channel(std::string_view name);

/// Channels of the same layer.
struct ChannelLayer {
  std::string_view name;     ///< refers to the channels' names
  std::vector<int> members;  ///< indices of the channels
};

/// The layers of channels, in the order of their first ones.
std::vector<ChannelLayer> layers_of_channels(std::span<const std::string> channels);

/// The one among `members`, indices of channels, that holds `meaning`: `R` rather than `r` or `red` where
/// there are both. −1 where there is none.
int channel_that_is(std::string_view meaning, std::span<const std::string> channels,
                    std::span<const int> members);

}  // namespace welkin::io
