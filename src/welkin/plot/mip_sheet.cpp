#include "welkin/plot/mip_sheet.h"

#include <algorithm>
#include <cmath>

#include "welkin/base/error.h"
#include "welkin/map/pyramid.h"
#include "welkin/map_file/layout.h"

namespace welkin {
namespace {

constexpr int kGap = 4;

/// A level in its layout, enlarged to fill `out`.
void draw_level(const Layout& layout, const Level& level, float scale, ImageView<float> out) {
  const int cell_width = out.width / layout.columns, cell_height = out.height / layout.rows;
  for (const LayoutCell& cell : layout.cells) {
    const ImageView<const float> chart = level.chart(cell.chart);
    Image picture(chart.width, chart.height, chart.channels);
    copy_to_cell(cell, chart, picture.view());
    for (int y = 0; y < cell_height; ++y) {
      for (int x = 0; x < cell_width; ++x) {
        const float* texel = picture.at(x * chart.width / cell_width, y * chart.height / cell_height);
        float* to = out.at(cell.column * cell_width + x, cell.row * cell_height + y);
        for (int c = 0; c < 3; ++c) to[c] = scale * texel[chart.channels >= 3 ? c : 0];
      }
    }
  }
}

}  // namespace

Image draw_mip_sheet(const Map& map, double exposure) {
  constexpr int kLargest = 512;
  if (map.width() > kLargest || map.height() > kLargest) {
    throw Error(ErrorKind::too_large,
                "a sheet of the pyramid is drawn of charts of at most 512 texels; this one is " +
                    std::to_string(map.width()) + "×" + std::to_string(map.height()) +
                    ": resample it to a smaller size first");
  }
  const Layout layout = layouts_of(map.parameterization).front();
  const float scale = static_cast<float>(std::exp2(exposure));
  const int levels = std::max(0, levels_below(map.width(), map.height()) - 1);
  const int width = layout.columns * map.width(), height = layout.rows * map.height();
  Image sheet((levels + 1) * (width + kGap) - kGap, 2 * height + kGap, 3);
  std::fill_n(sheet.view().data,
              static_cast<std::size_t>(sheet.width()) * static_cast<std::size_t>(sheet.height()) * 3, 0.2f);
  int y = 0;
  for (const TexelWeight weight : {TexelWeight::equal, TexelWeight::solid_angle}) {
    const std::vector<Level> pyramid = make_pyramid(map, levels, weight);
    for (int i = 0; i <= levels; ++i) {
      const Level& level = i == 0 ? map.level : pyramid[static_cast<std::size_t>(i - 1)];
      draw_level(layout, level, scale, sheet.view().part(i * (width + kGap), y, width, height));
    }
    y += height + kGap;
  }
  return sheet;
}

}  // namespace welkin
