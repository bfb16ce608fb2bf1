#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "welkin/base/error.h"
#include "welkin/base/parallel.h"
#include "welkin/map/adjust.h"
#include "welkin/map/borders.h"
#include "welkin/map/row_bands.h"
#include "welkin/map/texel_grid.h"

namespace welkin {
namespace {

/// How often what lies behind the first ring of a hole is smoothed, at most.
constexpr int kSweeps = 16;

using Index = TexelGrid::Index;

/// Fills the holes of one channel after another.
class HoleFiller {
 public:
  HoleFiller(Map& map, float replacement)
      : map_(map), grid_(map), replacement_(replacement), states_(static_cast<std::size_t>(grid_.size())) {}

  /// `holes`: texels with a value that isn't finite in the channel, in order.
  void fill(int channel, std::span<const Index> holes) {
    channel_ = channel;
    for (const Index hole : holes) state(hole) = State::hole;
    const std::vector<Index> rest = without_lost_charts(holes);
    std::vector<Index> filled;
    const auto [first_ring, rings] = fill_rings(rest, filled);
    smooth(std::span(filled).subspan(first_ring), std::min(2 * rings, kSweeps));
    for (const Index hole : holes) state(hole) = State::known;
  }

 private:
  enum class State : std::uint8_t { known, hole, queued, lost };

  State& state(Index texel) { return states_[static_cast<std::size_t>(texel)]; }
  float& value(Index texel) {
    const Index row = texel / map_.width();
    return map_.level.chart(static_cast<int>(row / map_.height()))
        .at(static_cast<int>(texel % map_.width()), static_cast<int>(row % map_.height()))[channel_];
  }

  /// Charts without a finite value get the replacement, which fills no other chart. Returns the other holes.
  std::vector<Index> without_lost_charts(std::span<const Index> holes) {
    std::vector<Index> rest;
    for (auto from = holes.begin(); from != holes.end();) {
      const Index chart = *from / grid_.chart_size();
      const auto to =
          std::find_if(from, holes.end(), [&](Index hole) { return hole / grid_.chart_size() != chart; });
      if (to - from == grid_.chart_size() || !has_valid_value(chart)) {
        for (auto hole = from; hole != to; ++hole) {
          value(*hole) = replacement_;
          state(*hole) = State::lost;
        }
      } else {
        rest.insert(rest.end(), from, to);
      }
      from = to;
    }
    return rest;
  }

  bool has_valid_value(Index chart) {
    for (Index texel = chart * grid_.chart_size(); texel < (chart + 1) * grid_.chart_size(); ++texel) {
      if (state(texel) == State::known && grid_.valid(texel)) return true;
    }
    return false;
  }

  /// The mean of known neighbours; none without any.
  std::optional<float> mean_around(Index texel) {
    double sum = 0;
    int count = 0;
    for (const Index each : grid_.neighbours(texel)) {
      if (state(each) != State::known) continue;
      sum += static_cast<double>(value(each));
      ++count;
    }
    if (count == 0) return std::nullopt;
    return static_cast<float>(sum / count);
  }

  struct Rings {
    std::size_t first;  ///< texels of the first one
    int count;
  };

  /// Ring after ring, each from the values before it; `filled` gets the texels in order.
  Rings fill_rings(const std::vector<Index>& holes, std::vector<Index>& filled) {
    Rings rings{0, 0};
    std::vector<Index> ring = holes, next;
    std::vector<float> values;
    for (;;) {
      // Of those that may be in the ring, the ones that are.
      std::size_t kept = 0;
      values.clear();
      for (const Index texel : ring) {
        const std::optional<float> mean = mean_around(texel);
        if (!mean) {
          state(texel) = State::hole;
          continue;
        }
        ring[kept++] = texel;
        values.push_back(*mean);
      }
      ring.resize(kept);
      if (ring.empty()) break;
      for (std::size_t i = 0; i < ring.size(); ++i) {
        value(ring[i]) = values[i];
        state(ring[i]) = State::known;
      }
      filled.insert(filled.end(), ring.begin(), ring.end());
      if (rings.count++ == 0) rings.first = filled.size();
      next.clear();
      for (const Index texel : ring) {
        for (const Index each : grid_.neighbours(texel)) {
          if (state(each) != State::hole) continue;
          state(each) = State::queued;
          next.push_back(each);
        }
      }
      // A neighbour across an edge need not be one in return.
      if (next.empty() && filled.size() < holes.size()) {
        std::copy_if(holes.begin(), holes.end(), std::back_inserter(next),
                     [&](Index hole) { return state(hole) == State::hole; });
      }
      std::swap(ring, next);
    }
    for (const Index hole : holes) {
      if (state(hole) != State::known) value(hole) = replacement_;
    }
    return rings;
  }

  /// Jacobi's iteration of the membrane that the texels around hold.
  void smooth(std::span<const Index> texels, int sweeps) {
    if (texels.empty()) return;
    std::vector<float> values(texels.size());
    const RowBands bands(static_cast<int>(std::min<std::size_t>(texels.size(), 1 << 20)));
    const auto for_bands = [&](const auto& body) {
      parallel_for(bands.count, [&](int band) {
        const std::size_t count = static_cast<std::size_t>(bands.count), i = static_cast<std::size_t>(band);
        for (std::size_t k = texels.size() * i / count; k < texels.size() * (i + 1) / count; ++k) body(k);
      });
    };
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      for_bands([&](std::size_t k) { values[k] = mean_around(texels[k]).value_or(value(texels[k])); });
      for_bands([&](std::size_t k) { value(texels[k]) = values[k]; });
    }
  }

  Map& map_;
  const TexelGrid grid_;
  const float replacement_;
  int channel_ = 0;
  std::vector<State> states_;
};

/// The texels of one channel that aren't finite.
using Holes = std::vector<Index>;

/// Those of each channel, in order; `texels` becomes how many have any.
std::vector<Holes> find_holes(const Map& map, std::uint64_t& texels) {
  const int width = map.width(), height = map.height(), channels = map.channels();
  const RowBands bands(map.charts() * height);
  struct Found {
    std::vector<Holes> holes;
    std::uint64_t texels = 0;
  };
  std::vector<Found> found(static_cast<std::size_t>(bands.count));
  parallel_for(bands.count, [&](int band) {
    Found& here = found[static_cast<std::size_t>(band)];
    here.holes.resize(static_cast<std::size_t>(channels));
    for (int row = bands.first(band); row < bands.first(band + 1); ++row) {
      const float* values = map.level.chart(row / height).row(row % height);
      float zero = 0;
      for (std::ptrdiff_t i = 0; i < std::ptrdiff_t{width} * channels; ++i) zero += values[i] * 0.0f;
      if (zero == 0) continue;
      for (int x = 0; x < width; ++x) {
        bool any = false;
        for (int c = 0; c < channels; ++c) {
          if (std::isfinite(*values++)) continue;
          here.holes[static_cast<std::size_t>(c)].push_back(Index{row} * width + x);
          any = true;
        }
        here.texels += any ? 1 : 0;
      }
    }
  });
  std::vector<Holes> all(static_cast<std::size_t>(channels));
  for (const Found& each : found) {
    texels += each.texels;
    for (std::size_t c = 0; c < all.size(); ++c) {
      all[c].insert(all[c].end(), each.holes[c].begin(), each.holes[c].end());
    }
  }
  return all;
}

/// change(value) on every value but those of the channel A; how many it changed.
template <class Change>
std::uint64_t change_values(Map& map, const Change& change) {
  const int channels = map.channels();
  const RowBands bands(map.charts() * map.height());
  std::vector<std::uint64_t> counts(static_cast<std::size_t>(bands.count));
  parallel_for(bands.count, [&](int band) {
    for (int row = bands.first(band); row < bands.first(band + 1); ++row) {
      float* value = map.level.chart(row / map.height()).row(row % map.height());
      for (int x = 0; x < map.width(); ++x) {
        for (int c = 0; c < channels; ++c, ++value) {
          if (map.channel_names[static_cast<std::size_t>(c)] == "A") continue;
          counts[static_cast<std::size_t>(band)] += change(*value) ? 1 : 0;
        }
      }
    }
  });
  std::uint64_t count = 0;
  for (const std::uint64_t each : counts) count += each;
  return count;
}

void check(const SanitizeOptions& options) {
  require(std::isfinite(options.replacement), "what holes of a map are filled with is finite");
  require(!options.infinite || (std::isfinite(*options.infinite) && *options.infinite > 0),
          "what infinite values become is finite and above 0");
  require(options.minimum <= options.maximum, "values are clamped between a minimum and a larger maximum");
}

}  // namespace

SanitizeReport sanitize(Map& map, const SanitizeOptions& options) {
  map.check();
  check(options);
  SanitizeReport report;
  if (options.infinite) {
    report.infinite = change_values(map, [&](float& value) {
      if (!std::isinf(value)) return false;
      value = value > 0 ? *options.infinite : options.negative_infinite ? -*options.infinite : 0.0f;
      return true;
    });
  }
  if (options.fill) {
    const std::vector<Holes> holes = find_holes(map, report.filled);
    if (report.filled > 0) {
      HoleFiller filler(map, options.replacement);
      for (std::size_t c = 0; c < holes.size(); ++c) filler.fill(static_cast<int>(c), holes[c]);
    }
  }
  if (std::isfinite(options.minimum) || std::isfinite(options.maximum)) {
    report.clamped = change_values(map, [&](float& value) {
      if (!(value < options.minimum) && !(value > options.maximum)) return false;
      value = std::clamp(value, options.minimum, options.maximum);
      return true;
    });
  }
  if (report.filled + report.infinite + report.clamped > 0) fill_borders(map, RimTexels::measured);
  return report;
}

}  // namespace welkin
