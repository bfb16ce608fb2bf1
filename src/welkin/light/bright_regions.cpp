#include "welkin/light/bright_regions.h"

#include <algorithm>

namespace welkin {
namespace {

using Index = TexelGrid::Index;

/// Peaks and what is joined to them: a forest of peaks, each below a higher one that it is part of.
class Peaks {
 public:
  using Number = std::int32_t;

  Number add(float luminance) {
    parents_.push_back(static_cast<Number>(parents_.size()));
    luminances_.push_back(luminance);
    return parents_.back();
  }
  /// The peak that this one is part of.
  Number top(Number peak) {
    while (parent(peak) != peak) peak = parent(peak) = parent(parent(peak));
    return peak;
  }
  void join(Number lower, Number higher) { parent(lower) = higher; }
  float luminance(Number peak) const { return luminances_[static_cast<std::size_t>(peak)]; }
  std::size_t count() const { return parents_.size(); }

 private:
  Number& parent(Number peak) { return parents_[static_cast<std::size_t>(peak)]; }
  std::vector<Number> parents_;
  std::vector<float> luminances_;
};

class RegionFinder {
 public:
  explicit RegionFinder(const Map& map)
      : map_(map),
        grid_(map),
        luminance_(map.channel_names),
        owner_(static_cast<std::size_t>(grid_.size()), kNone) {}

  std::vector<BrightRegion> find(std::vector<BrightTexel> bright) {
    std::sort(bright.begin(), bright.end(), [](const BrightTexel& a, const BrightTexel& b) {
      return a.luminance != b.luminance ? a.luminance > b.luminance : a.texel < b.texel;
    });
    flood(bright);
    std::vector<BrightRegion> regions = collect(bright);
    for (int ring = 0; ring < kRimTexels; ++ring) grow(regions);
    for (BrightRegion& region : regions) look_around(region);
    return regions;
  }

 private:
  static constexpr Peaks::Number kNone = -1;

  Peaks::Number& owner(Index texel) { return owner_[static_cast<std::size_t>(texel)]; }
  float luminance(Index texel) const {
    const auto [chart, x, y] = grid_.place(texel);
    return luminance_(map_.level.chart(chart).at(x, y));
  }
  TexelGrid::Neighbours neighbours(Index texel) const {
    return grid_.neighbours(texel, TexelGrid::Rim::open);
  }

  /// From the brightest down, as falling water lays islands bare: a texel belongs to what it touches, or is a
  /// new peak. Where it touches two, the lower one is part of the higher, unless it rises far above the
  /// saddle.
  void flood(const std::vector<BrightTexel>& bright) {
    std::vector<Peaks::Number> tops;
    for (const auto& [texel, value] : bright) {
      tops.clear();
      for (const Index each : neighbours(texel)) {
        if (owner(each) == kNone) continue;
        const Peaks::Number top = peaks_.top(owner(each));
        if (std::find(tops.begin(), tops.end(), top) == tops.end()) tops.push_back(top);
      }
      if (tops.empty()) {
        owner(texel) = peaks_.add(value);
        continue;
      }
      // Peaks are numbered as they are found, so the smallest number is the highest.
      std::sort(tops.begin(), tops.end());
      for (std::size_t i = 1; i < tops.size(); ++i) {
        const float lower = peaks_.luminance(tops[i]), higher = peaks_.luminance(tops.front());
        if (value > (lower < kMinor * higher ? kMinorSaddle : kSaddle) * lower)
          peaks_.join(tops[i], tops.front());
      }
      owner(texel) = nearest_top(texel, tops.front());
    }
  }

  /// That of the brightest neighbour.
  Peaks::Number nearest_top(Index texel, Peaks::Number top) {
    float brightest = 0;
    for (const Index each : neighbours(texel)) {
      const float value = owner(each) == kNone ? 0 : luminance(each);
      if (value <= brightest) continue;
      brightest = value;
      top = peaks_.top(owner(each));
    }
    return top;
  }

  /// Texels too faint beside their peak are let go.
  std::vector<BrightRegion> collect(const std::vector<BrightTexel>& bright) {
    std::vector<BrightRegion> regions;
    std::vector<Peaks::Number> region_of(peaks_.count(), kNone);
    for (const auto& [texel, value] : bright) {
      const Peaks::Number top = peaks_.top(owner(texel));
      owner(texel) = kNone;
      if (value < kFaintest * peaks_.luminance(top)) continue;
      Peaks::Number& region = region_of[static_cast<std::size_t>(top)];
      if (region == kNone) {
        region = static_cast<Peaks::Number>(regions.size());
        regions.emplace_back().peak = value;
      }
      owner(texel) = region;
      BrightRegion& found = regions[static_cast<std::size_t>(region)];
      found.texels.push_back(texel);
      found.core = found.texels.size();
    }
    return regions;
  }

  /// One texel all around, downhill. Regions take turns, the brightest first.
  void grow(std::vector<BrightRegion>& regions) {
    for (std::size_t i = 0; i < regions.size(); ++i) {
      std::vector<Index>& texels = regions[i].texels;
      const std::size_t before = texels.size();
      for (std::size_t k = 0; k < before; ++k) {
        const float here = luminance(texels[k]);
        for (const Index each : neighbours(texels[k])) {
          if (owner(each) != kNone || luminance(each) > here) continue;
          owner(each) = static_cast<Peaks::Number>(i);
          texels.push_back(each);
        }
      }
    }
  }

  void look_around(BrightRegion& region) {
    for (std::size_t k = 0; k < region.texels.size(); ++k) {
      const TexelGrid::Neighbours beside = neighbours(region.texels[k]);
      if (k < region.core && beside.count < 8) region.cut = !map_.parameterization.whole_world();
      for (const Index each : beside) {
        if (owner(each) == kNone) region.around.push_back(each);
      }
    }
    std::sort(region.around.begin(), region.around.end());
    region.around.erase(std::unique(region.around.begin(), region.around.end()), region.around.end());
  }

  const Map& map_;
  const TexelGrid grid_;
  const TexelLuminance luminance_;
  Peaks peaks_;
  std::vector<Peaks::Number> owner_;
};

}  // namespace

std::vector<BrightRegion> find_bright_regions(const Map& map, std::vector<BrightTexel> bright) {
  if (bright.empty()) return {};
  return RegionFinder(map).find(std::move(bright));
}

}  // namespace welkin
