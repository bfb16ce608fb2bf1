#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace welkin {

/// The channels that are light: all but A, unless there is no other.
inline std::vector<int> light_channels(const std::vector<std::string>& names) {
  std::vector<int> channels;
  for (std::size_t c = 0; c < names.size(); ++c) {
    if (names[c] != "A" || names.size() == 1) channels.push_back(static_cast<int>(c));
  }
  return channels;
}

/// Luminance of a texel by its channels' names: ITU-R BT.709 weights for R, G, B; without these the channel
/// Y, or the first.
class TexelLuminance {
 public:
  explicit TexelLuminance(const std::vector<std::string>& channel_names) : r_(find(channel_names, "R")) {
    g_ = find(channel_names, "G");
    b_ = find(channel_names, "B");
    if (r_ < 0 || g_ < 0 || b_ < 0) {
      r_ = std::max(find(channel_names, "Y"), 0);
      g_ = b_ = -1;
    }
  }

  float operator()(const float* texel) const {
    return g_ < 0 ? texel[r_] : 0.2126f * texel[r_] + 0.7152f * texel[g_] + 0.0722f * texel[b_];
  }

  /// Of sums over texels, one for each channel: luminance is linear.
  double of_sums(const double* sums) const {
    return g_ < 0 ? sums[r_] : 0.2126 * sums[r_] + 0.7152 * sums[g_] + 0.0722 * sums[b_];
  }

 private:
  static int find(const std::vector<std::string>& names, std::string_view name) {
    const auto at = std::find(names.begin(), names.end(), name);
    return at == names.end() ? -1 : static_cast<int>(at - names.begin());
  }

  int r_, g_ = -1, b_ = -1;
};

}  // namespace welkin
