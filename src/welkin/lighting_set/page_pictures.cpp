#include "welkin/lighting_set/page_pictures.h"

#include <algorithm>
#include <utility>

#include "welkin/filter/resample.h"
#include "welkin/io/image_file.h"
#include "welkin/lighting_set/encoded_files.h"
#include "welkin/map_file/layout.h"
#include "welkin/math/rotation.h"

namespace welkin::lighting_set {
namespace {

/// Turned a little, so that a ball doesn't look straight at a face of a cube.
const Matrix3& view() {
  static const Matrix3 turn = rotation_from_yaw_pitch_roll(20, 0, 0);
  return turn;
}

/// A ball is seen from outside.
constexpr Matrix3 kMirrored{{{{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}};

std::string encoded(const Image& image, std::string_view format, std::string_view media_type) {
  const io::WritePart part{"", image.view(), default_channel_names(image.channels())};
  io::WriteOptions options;
  options.type = io::PixelType::uint8;
  options.quality = 85;
  io::MemorySink sink;
  io::write(sink, format, {&part, 1}, options);
  return data_url(media_type, sink.bytes());
}

Image scaled(ImageView<const float> view, double factor) {
  Image image(view.width, view.height, view.channels);
  const std::size_t row = static_cast<std::size_t>(view.width) * static_cast<std::size_t>(view.channels);
  for (int y = 0; y < view.height; ++y) {
    std::transform(view.row(y), view.row(y) + row, image.view().row(y),
                   [&](float value) { return value * static_cast<float>(factor); });
  }
  return image;
}

std::string ball(const Map& map, const char* parameterization, const Matrix3& rotation, int width,
                 const PagePictures& page) {
  Map picture(sphere::AnyParameterization::make(parameterization), width, width, map.channels());
  picture.channel_names = map.channel_names;
  resample(map, picture, {.filter = Filter::bilinear, .rotation = rotation, .monitor = page.monitor});
  return encoded(scaled(std::as_const(picture.level).chart(0), page.exposure), "png", "image/png");
}

}  // namespace

std::string PagePictures::mirror_ball(const Map& map, int width) const {
  return ball(map, "sphere", view(), width, *this);
}

std::string PagePictures::normal_ball(const Map& map, int width) const {
  return ball(map, "fisheye-orthographic", kMirrored, width, *this);
}

std::string PagePictures::panorama(const Map& map) const {
  return encoded(scaled(map.level.chart(0), exposure), "jpeg", "image/jpeg");
}

std::string PagePictures::cross(const Map& map) const {
  const std::vector<Layout> layouts = layouts_of(map.parameterization);
  const auto named =
      std::find_if(layouts.begin(), layouts.end(), [](const Layout& l) { return l.name == "hcross"; });
  const Layout& layout = named == layouts.end() ? layouts.front() : *named;
  std::vector<ImageView<const float>> charts;
  for (int chart = 0; chart < map.charts(); ++chart) charts.push_back(map.level.chart(chart));
  Image picture(layout.columns * map.width(), layout.rows * map.height(), map.channels());
  draw_rows(layout, charts, 0, picture.view());
  return encoded(scaled(std::as_const(picture).view(), exposure), "png", "image/png");
}

}  // namespace welkin::lighting_set
