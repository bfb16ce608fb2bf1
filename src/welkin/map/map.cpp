#include "welkin/map/map.h"

#include <algorithm>
#include <vector>

#include "welkin/base/error.h"
#include "welkin/map/borders.h"

namespace welkin {

Level::Level(int charts, int width, int height, int channels, PixelContents contents)
    : charts_(charts), width_(width), height_(height) {
  require(charts > 0, "a level has at least one chart");
  constexpr int kLargestSide = 1 << 20;
  if (width < 1 || height < 1 || width > kLargestSide || height > kLargestSide / charts) {
    throw Error(width < 1 || height < 1 ? ErrorKind::bad_request : ErrorKind::too_large,
                "a map of " + std::to_string(charts) + " charts of " + std::to_string(width) + "×" +
                    std::to_string(height) + " texels cannot be made (a side is 1 to " +
                    std::to_string(kLargestSide / charts) + ")");
  }
  if (channels < 1 || channels > kMaxChannels) {
    throw Error(ErrorKind::bad_request, "a map has 1 to " + std::to_string(kMaxChannels) + " channels, not " +
                                            std::to_string(channels));
  }
  storage_ = Image(width + 2 * kBorder, (height + 2 * kBorder) * charts, channels, contents);
}

ImageView<float> Level::chart(int index) {
  require(index >= 0 && index < charts_, "the level has no chart of that number");
  return storage_.view().part(kBorder, index * (height_ + 2 * kBorder) + kBorder, width_, height_);
}

ImageView<const float> Level::chart(int index) const {
  require(index >= 0 && index < charts_, "the level has no chart of that number");
  return storage_.view().part(kBorder, index * (height_ + 2 * kBorder) + kBorder, width_, height_);
}

std::ptrdiff_t Level::chart_stride() const {
  return (height_ + 2 * kBorder) * storage_.view().row_stride;
}

std::vector<std::string> default_channel_names(int count) {
  switch (count) {
    case 1:
      return {"Y"};
    case 2:
      return {"Y", "A"};
    case 3:
      return {"R", "G", "B"};
    case 4:
      return {"R", "G", "B", "A"};
    default:
      break;
  }
  std::vector<std::string> names;
  for (int i = 0; i < count; ++i) names.push_back("C" + std::to_string(i));
  return names;
}

Map::Map(sphere::AnyParameterization which, int width, int height, int channels, PixelContents contents)
    : parameterization(which.at_size(width, height)),
      level(parameterization.charts(), width, height, channels, contents),
      channel_names(default_channel_names(channels)) {}

Map Map::clone() const {
  Map copy(parameterization, width(), height(), channels(), PixelContents::unset);
  copy.parameterization = parameterization;
  copy.channel_names = channel_names;
  copy.orientation = orientation;
  const int rows = height() + 2 * kBorder;
  const std::ptrdiff_t values = static_cast<std::ptrdiff_t>(width() + 2 * kBorder) * channels();
  for (int chart = 0; chart < charts(); ++chart) {
    for (int y = -kBorder; y < rows - kBorder; ++y)
      std::copy_n(level.chart(chart).at(-kBorder, y), values, copy.level.chart(chart).at(-kBorder, y));
  }
  return copy;
}

void Map::check() const {
  require(charts() == parameterization.charts() && width() > 0 && height() > 0,
          "a map's level has another number of charts than its parameterization");
  require(channel_names.size() == static_cast<std::size_t>(channels()),
          "a map has another number of channels than names for them");
  require(is_orthonormal(orientation), "a map's orientation is a rotation or a reflection");
}

Map Map::from_pixels(const sphere::AnyParameterization& which, std::span<const Pixels> charts) {
  if (charts.size() != static_cast<std::size_t>(which.charts())) {
    throw Error(ErrorKind::mismatch, which.name() + " has " + std::to_string(which.charts()) +
                                         " charts, but pixels of " + std::to_string(charts.size()) +
                                         " were given");
  }
  const Pixels& first = charts.front();
  Map map(which, first.width, first.height, first.channels, PixelContents::unset);
  for (int chart = 0; chart < map.charts(); ++chart)
    copy_pixels(charts[static_cast<std::size_t>(chart)], map.level.chart(chart));
  fill_borders(map, RimTexels::measured);
  return map;
}

Map Map::from_pixels(const sphere::AnyParameterization& which, const Pixels& chart) {
  return from_pixels(which, {&chart, 1});
}

}  // namespace welkin
