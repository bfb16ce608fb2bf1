#include "welkin/io/channel_names.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

namespace welkin::io {

bool is_alpha_added(const std::map<std::string, std::string>& attributes) {
  const auto names = attributes.find(kChannelsKey);
  return names != attributes.end() && ("," + names->second + ",").find(",A,") == std::string::npos;
}

std::string_view meaning_of_channel(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 15> kMeanings{{{"r", "R"},
                                                                                     {"red", "R"},
                                                                                     {"g", "G"},
                                                                                     {"green", "G"},
                                                                                     {"b", "B"},
                                                                                     {"blue", "B"},
                                                                                     {"a", "A"},
                                                                                     {"alpha", "A"},
                                                                                     {"y", "Y"},
                                                                                     {"l", "Y"},
                                                                                     {"luminance", "Y"},
                                                                                     {"x", "X"},
                                                                                     {"z", "Z"},
                                                                                     {"zback", "Z"},
                                                                                     {"depth", "Z"}}};
  name.remove_prefix(name.rfind('.') + 1);  // nothing without a dot: npos + 1 is 0
  const auto same = [](char small, char any) {
    return small == std::tolower(static_cast<unsigned char>(any));
  };
  for (const auto& [known, meaning] : kMeanings) {
    if (std::equal(known.begin(), known.end(), name.begin(), name.end(), same)) return meaning;
  }
  return {};
}

std::string_view layer_of_channel(std::string_view name) {
  const std::size_t dot = name.rfind('.');
  return dot == std::string_view::npos ? std::string_view() : name.substr(0, dot);
}

std::vector<ChannelLayer> layers_of_channels(std::span<const std::string> channels) {
  std::vector<ChannelLayer> layers;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const std::string_view name = layer_of_channel(channels[i]);
    auto layer = std::find_if(layers.begin(), layers.end(),
                              [&](const ChannelLayer& each) { return each.name == name; });
    if (layer == layers.end()) layer = layers.insert(layers.end(), {name, {}});
    layer->members.push_back(static_cast<int>(i));
  }
  return layers;
}

int channel_that_is(std::string_view meaning, std::span<const std::string> channels,
                    std::span<const int> members) {
  int found = -1;
  for (const int member : members) {
    const std::string_view name = channels[static_cast<std::size_t>(member)];
    if (meaning_of_channel(name) != meaning) continue;
    if (name.substr(name.rfind('.') + 1) == meaning) return member;  // npos + 1 is 0
    if (found < 0) found = member;
  }
  return found;
}

}  // namespace welkin::io
