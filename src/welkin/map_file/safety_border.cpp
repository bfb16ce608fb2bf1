#include "welkin/map_file/safety_border.h"

#include <algorithm>
#include <string>

#include "welkin/base/error.h"
#include "welkin/filter/sampler.h"

namespace welkin {

void check_border(int border, ChartSize size) {
  if (border >= 0 && border <= size.width && border <= size.height) return;
  throw Error(ErrorKind::mismatch, "a border of " + std::to_string(border) +
                                       " texels is wider than a chart of " + std::to_string(size.width) +
                                       "×" + std::to_string(size.height));
}

Image with_safety_border(const Map& map, int index, int border) {
  const int width = map.width(), height = map.height(), channels = map.channels();
  check_border(border, {width, height});
  const ImageView<const float> chart = map.level.chart(index);
  const auto& p = map.parameterization;
  const Sampler sampler = Sampler::borrow(map, {.filter = Filter::bicubic});
  Image out(width + 2 * border, height + 2 * border, channels);
  const auto outside = [&](int x, int y, float* to) {
    const Vec3d d = p.to_sphere(index, (x + 0.5) / width, (y + 0.5) / height);
    if (p.covers(d)) {
      const Vec3d world = transpose(map.orientation) * d;
      return sampler.look_up(world, {to, static_cast<std::size_t>(channels)});
    }
    std::copy_n(chart.at(std::clamp(x, 0, width - 1), std::clamp(y, 0, height - 1)), channels, to);
  };
  for (int y = -border; y < height + border; ++y) {
    for (int x = -border; x < width + border; ++x) {
      float* to = out.at(x + border, y + border);
      const bool filled = x >= -kBorder && x < width + kBorder && y >= -kBorder && y < height + kBorder;
      if (filled) {
        std::copy_n(chart.at(x, y), channels, to);
      } else {
        outside(x, y, to);
      }
    }
  }
  return out;
}

int coarsest_level_served(int border, int size) {
  if (border <= 0) return -1;
  int level = 0;
  while (border % (2 << level) == 0 && size % (2 << level) == 0) ++level;
  return level;
}

}  // namespace welkin
