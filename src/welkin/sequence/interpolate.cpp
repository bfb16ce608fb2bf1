#include "welkin/sequence/interpolate.h"

#include "welkin/base/error.h"
#include "welkin/base/parallel.h"

namespace welkin {
namespace {

void check_alike(const Chain& from, const Chain& to) {
  bool alike = from.levels.size() == to.levels.size();
  for (std::size_t k = 0; alike && k < from.levels.size(); ++k) {
    const Map &a = from.levels[k], &b = to.levels[k];
    alike = a.parameterization == b.parameterization && a.width() == b.width() && a.height() == b.height() &&
            a.channel_names == b.channel_names && a.orientation == b.orientation;
  }
  if (!alike)
    throw Error(ErrorKind::mismatch,
                "chains to interpolate differ in levels, sizes, channels, parameterization or orientation");
}

Map between(const Map& from, const Map& to, float t) {
  Map map(from.parameterization, from.width(), from.height(), from.channels(), PixelContents::unset);
  map.channel_names = from.channel_names;
  map.orientation = from.orientation;
  const int rows = map.height() + 2 * kBorder, values = (map.width() + 2 * kBorder) * map.channels();
  parallel_for(map.charts() * rows, [&](int i) {
    const int y = i % rows - kBorder;
    const float* a = from.level.chart(i / rows).at(-kBorder, y);
    const float* b = to.level.chart(i / rows).at(-kBorder, y);
    float* out = map.level.chart(i / rows).at(-kBorder, y);
    // Exact at both ends, and for equal values.
    for (int x = 0; x < values; ++x)
      out[x] = t < 0.5f ? a[x] + t * (b[x] - a[x]) : b[x] - (1 - t) * (b[x] - a[x]);
  });
  return map;
}

}  // namespace

Chain interpolated(const Chain& from, const Chain& to, double t) {
  require(t >= 0 && t <= 1, "chains are interpolated for t from 0 to 1");
  check_alike(from, to);
  Chain chain;
  chain.notes = from.notes;
  for (std::size_t k = 0; k < from.levels.size(); ++k)
    chain.levels.push_back(between(from.levels[k], to.levels[k], static_cast<float>(t)));
  return chain;
}

}  // namespace welkin
