#include "welkin/prefilter/playcanvas_atlas.h"

#include <algorithm>

#include "welkin/base/error.h"

namespace welkin {
namespace {

constexpr int kSide = 512;
/// The engine reads roughness r at rectangle 5r; the sixth is never weighted, and only looked up.
constexpr double kRoughness[] = {0.2, 0.4, 0.6, 0.8, 1, 1};

}  // namespace

std::vector<AtlasRectangle> playcanvas_rectangles() {
  std::vector<AtlasRectangle> list;
  for (int i = 0; i < 6; ++i) {
    const int width = kSide >> i;
    list.push_back({kSide - width, kSide - width, width, width / 2, lobe::AnyLobe::mirror()});
  }
  const lobe::AnyLobe ggx = lobe::AnyLobe::make("ggx");
  for (int i = 1; i <= 6; ++i) {
    const int width = kSide >> i;
    list.push_back({0, kSide - width, width, width / 2, ggx.with_roughness(kRoughness[i - 1])});
  }
  list.push_back({128, 384, 64, 32, lobe::AnyLobe::make("lambert")});
  return list;
}

Image playcanvas_atlas(const Map& source, const PrefilterOptions& options, const Monitor& monitor) {
  require(source.channel_names == default_channel_names(3), "an atlas for PlayCanvas is of R G B");
  const std::vector<AtlasRectangle> rectangles = playcanvas_rectangles();
  std::vector<PrefilterLevel> levels;
  for (const AtlasRectangle& each : rectangles)
    levels.push_back({{each.width - 2, each.height - 2}, each.lobe});
  PrefilterOptions with_borders = options;
  with_borders.borders = true;
  const std::vector<Map> maps =
      prefilter_map(source, sphere::AnyParameterization::make("latlong"), levels, with_borders, monitor);
  Image atlas(kSide, kSide, 3);
  for (std::size_t i = 0; i < maps.size(); ++i) {
    const AtlasRectangle& to = rectangles[i];
    for (int y = 0; y < to.height; ++y)
      std::copy_n(maps[i].level.chart(0).at(-1, y - 1), 3 * to.width, atlas.at(to.x, to.y + y));
  }
  return atlas;
}

}  // namespace welkin
