#include "welkin/measure/common_channels.h"

#include <algorithm>

#include "welkin/base/error.h"

namespace welkin {

std::vector<ChannelPair> common_channels(const std::vector<std::string>& a,
                                         const std::vector<std::string>& b) {
  std::vector<ChannelPair> pairs;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const auto at = std::find(b.begin(), b.end(), a[i]);
    if (at != b.end())
      pairs.push_back({a[i], static_cast<int>(i), static_cast<int>(at - b.begin()), a[i] != "A"});
  }
  if (pairs.empty() && a.size() == b.size()) {
    for (std::size_t i = 0; i < a.size(); ++i)
      pairs.push_back({a[i], static_cast<int>(i), static_cast<int>(i), true});
  }
  if (pairs.empty())
    throw Error(ErrorKind::mismatch, "the maps have no channels in common, and cannot be compared");
  if (std::none_of(pairs.begin(), pairs.end(), [](const ChannelPair& pair) { return pair.counts; })) {
    for (ChannelPair& pair : pairs) pair.counts = true;
  }
  return pairs;
}

}  // namespace welkin
