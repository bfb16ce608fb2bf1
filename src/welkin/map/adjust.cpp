#include "welkin/map/adjust.h"

#include <algorithm>
#include <vector>

#include "welkin/base/error.h"
#include "welkin/base/parallel.h"

namespace welkin {
void scale(Map& map, float factor) {
  map.check();
  std::vector<float> factors;
  for (const std::string& name : map.channel_names) factors.push_back(name == "A" ? 1.0f : factor);
  // The borders too: what lies past an edge is a weighted sum of texels.
  const int rows = map.height() + 2 * kBorder, columns = map.width() + 2 * kBorder;
  parallel_for(map.charts() * rows, [&](int i) {
    float* value = map.level.chart(i / rows).at(-kBorder, i % rows - kBorder);
    for (int x = 0; x < columns; ++x) {
      for (const float each : factors) *value++ *= each;
    }
  });
}

void turn_world(Map& map, const Matrix3& rotation) {
  require(is_orthonormal(rotation), "a world is turned by a rotation or a reflection");
  map.orientation = map.orientation * transpose(rotation);
}

Map without_alpha(const Map& map) {
  require(map.channel_names == std::vector<std::string>{"R", "G", "B", "A"},
          "alpha is dropped of a map of R G B A");
  Map rgb(map.parameterization, map.width(), map.height(), 3);
  rgb.orientation = map.orientation;
  const int rows = map.height() + 2 * kBorder, columns = map.width() + 2 * kBorder;
  parallel_for(map.charts() * rows, [&](int i) {
    const float* from = map.level.chart(i / rows).at(-kBorder, i % rows - kBorder);
    float* to = rgb.level.chart(i / rows).at(-kBorder, i % rows - kBorder);
    for (int x = 0; x < columns; ++x) std::copy_n(from + 4 * x, 3, to + 3 * x);
  });
  return rgb;
}

}  // namespace welkin
