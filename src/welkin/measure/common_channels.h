#pragma once

#include <string>
#include <vector>

#include "welkin/map/map.h"

/// Internal to measure.
namespace welkin {

/// A channel that two maps have.
struct ChannelPair {
  std::string name;
  int a, b;     ///< which it is in either
  bool counts;  ///< in measures of all channels: not A, unless there is no other
};

/// By name; where no name agrees and both have as many, by position. Throws Error (mismatch) where there is
/// none.
std::vector<ChannelPair> common_channels(const std::vector<std::string>& a,
                                         const std::vector<std::string>& b);

}  // namespace welkin
