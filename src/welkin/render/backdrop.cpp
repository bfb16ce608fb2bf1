#include "welkin/render/backdrop.h"

#include <algorithm>
#include <vector>

#include "welkin/base/error.h"
#include "welkin/base/parallel.h"
#include "welkin/camera/view.h"
#include "welkin/lookup/cone_shapes.h"
#include "welkin/render/camera_rays.h"
#include "welkin/render/proxy_rays.h"

namespace welkin::scene {
namespace {

/// The world on its proxy, seen from the camera's place.
Map seen_on_proxy(const MapFrame& frame, const Vec3d& position, const World& world, const Monitor& monitor) {
  const CameraRays camera(frame, position);
  const ConeSampler& cones = world.cones();
  const auto channels = static_cast<std::size_t>(cones.channels());
  const auto [width, height] = frame.size;
  Map picture(frame.parameterization, width, height, cones.channels());
  parallel_for(
      height,
      [&, width = width](int y) {
        std::vector<PicturePlace> places;
        for (int x = 0; x < width; ++x)
          places.push_back({static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f});
        std::vector<RaySpread> rays;
        std::vector<bool> valid;
        camera.rays(places, 1, rays, valid);
        std::vector<EllipticalCone> seen;
        std::vector<std::size_t> columns;
        for (std::size_t x = 0; x < rays.size(); ++x) {
          if (!valid[x]) continue;
          seen.push_back(cone_of(seen_from(world.proxy(), {position}, direction_of(rays[x]))));
          columns.push_back(x);
        }
        std::vector<float> values(seen.size() * channels);
        cones.look_up(seen, values);
        for (std::size_t k = 0; k < columns.size(); ++k)
          std::copy_n(values.data() + k * channels, channels,
                      picture.level.chart(0).at(static_cast<int>(columns[k]), y));
      },
      monitor);
  return picture;
}

}  // namespace

void show_behind(Image& picture, const PlacedCamera& camera, const World& world, const Monitor& monitor) {
  const MapFrame frame = frame_of(camera.camera);
  if (picture.width() != frame.size.width || picture.height() != frame.size.height || picture.channels() != 4)
    throw Error(ErrorKind::mismatch, "the picture isn't R G B A of the camera's size");
  ResampleOptions shown;
  shown.borders = false;
  shown.monitor = monitor;
  const bool far = world.proxy().shape == Proxy::Shape::far;
  const Map behind =
      far ? view(world.map(), camera.camera, shown) : seen_on_proxy(frame, camera.position, world, monitor);
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
