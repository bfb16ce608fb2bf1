#include "welkin/render/backdrop.h"

#include <algorithm>

#include "welkin/base/error.h"
#include "welkin/camera/view.h"

namespace welkin::scene {

void show_behind(Image& picture, const Camera& camera, const World& world, const Monitor& monitor) {
  const MapFrame frame = frame_of(camera);
  if (picture.width() != frame.size.width || picture.height() != frame.size.height || picture.channels() != 4)
    throw Error(ErrorKind::mismatch, "the picture isn't R G B A of the camera's size");
  ResampleOptions shown;
  shown.borders = false;
  shown.monitor = monitor;
  const Map behind = view(world.map(), camera, shown);
  const int channels = behind.channels();
  const ImageView<const float> seen = behind.level.chart(0);
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      float* to = picture.at(x, y);
      const float through = std::max(0.0f, 1 - to[3]);
      const float* from = seen.at(x, y);
      for (int c = 0; c < 3; ++c) to[c] += through * from[channels >= 3 ? c : 0];
      const double u = (x + 0.5) / picture.width(), v = (y + 0.5) / picture.height();
      to[3] = frame.parameterization.valid(0, u, v) ? 1.0f : to[3];
    }
  }
}

}  // namespace welkin::scene
