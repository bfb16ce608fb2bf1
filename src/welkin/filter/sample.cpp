#include "welkin/filter/sample.h"

#include <algorithm>
#include <cassert>
#include <vector>

#include "welkin/filter/fetch.h"

namespace welkin {

void sample(const Map& map, const Level& level, std::span<const Vec3d> directions, Filter filter,
            std::span<float> out) {
  const std::size_t channels = static_cast<std::size_t>(level.channels());
  assert(out.size() == directions.size() * channels);
  const Fetch fetch = fetch_for(filter, false, level.channels());
  const LevelView view = view_of(level);
  // Places are found in double precision: one direction may be all that is asked for.
  constexpr std::size_t kBatch = 64;
  float chart[kBatch], u[kBatch], v[kBatch];
  std::vector<float> values(kBatch * channels + 8);
  for (std::size_t from = 0; from < directions.size(); from += kBatch) {
    const std::size_t count = std::min(kBatch, directions.size() - from);
    bool covered[kBatch];
    for (std::size_t i = 0; i < sphere::padded(count); ++i) {
      const Vec3d d = map.orientation * normalize(directions[from + std::min(i, count - 1)]);
      const auto place = map.parameterization.from_sphere(d);
      covered[i] = map.parameterization.covers(d);
      chart[i] = static_cast<float>(place.chart);
      u[i] = static_cast<float>(place.u);
      v[i] = static_cast<float>(place.v);
    }
    fetch(view, chart, u, v, values.data(), count);
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t c = 0; c < channels; ++c) {
        out[(from + i) * channels + c] = covered[i] ? values[i * channels + c] : 0.0f;
      }
    }
  }
}

}  // namespace welkin
