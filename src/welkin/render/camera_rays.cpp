#include "welkin/render/camera_rays.h"

#include <algorithm>

#include "welkin/sphere/kernels.h"

namespace welkin::scene {

CameraRays::CameraRays(MapFrame frame, const Vec3d& position)
    : frame_(std::move(frame)), to_world_(transpose(frame_.orientation)), position_(position) {}

void CameraRays::rays(std::span<const PicturePlace> places, double spacing, std::vector<RaySpread>& rays,
                      std::vector<bool>& valid) const {
  const std::size_t count = places.size(), padded = sphere::padded(count);
  rays.resize(count);
  valid.assign(count, false);
  const sphere::AnyParameterization& lens = frame_.parameterization;
  const float width = static_cast<float>(frame_.size.width), height = static_cast<float>(frame_.size.height);
  const auto half = static_cast<float>(spacing / 2);
  std::vector<float> u(padded), v(padded), x(padded), y(padded), z(padded), mask(padded);
  std::vector<Vec3d> ways[5];
  // Places of one chart come together.
  for (std::size_t first = 0; first < count;) {
    std::size_t last = first + 1;
    while (last < count && places[last].chart == places[first].chart) ++last;
    const std::size_t run = last - first;
    const int chart = places[first].chart;
    // The middle, left and right, above and below.
    constexpr int kSteps[5][2] = {{0, 0}, {-1, 0}, {1, 0}, {0, -1}, {0, 1}};
    for (std::size_t way = 0; way < 5; ++way) {
      for (std::size_t i = 0; i < padded; ++i) {
        const PicturePlace& place = places[first + std::min(i, run - 1)];
        u[i] = (place.x + half * static_cast<float>(kSteps[way][0])) / width;
        v[i] = (place.y + half * static_cast<float>(kSteps[way][1])) / height;
      }
      if (way == 0) {
        lens.kernels().valid(lens.self(), chart, u.data(), v.data(), mask.data(), run);
        for (std::size_t i = 0; i < run; ++i) valid[first + i] = mask[i] > 0;
      }
      lens.kernels().to_sphere(lens.self(), chart, u.data(), v.data(), x.data(), y.data(), z.data(), run);
      ways[way].resize(run);
      for (std::size_t i = 0; i < run; ++i) ways[way][i] = to_world_ * Vec3d{x[i], y[i], z[i]};
    }
    for (std::size_t i = 0; i < run; ++i)
      rays[first + i] = {
          position_, normalize(ways[0][i]), {}, {ways[2][i] - ways[1][i], ways[4][i] - ways[3][i]}};
    first = last;
  }
}

}  // namespace welkin::scene
