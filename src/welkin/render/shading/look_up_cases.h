#pragma once

#include <cmath>

#include "welkin/map/borders.h"
#include "welkin/render/path/path_tracer.h"
#include "welkin/render/render_cases.h"
#include "welkin/render/shading/shading.h"

/// How far `material` by look-ups is from paths, for tests.
namespace welkin::scene {

/// A world that changes slowly: harmonics up to degree 2.
inline World smooth_world() {
  Map map(sphere::AnyParameterization::make("latlong"), 128, 64, 3);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 128; ++x) {
      const Vec3d d = map.parameterization.to_sphere(0, (x + 0.5) / 128, (y + 0.5) / 64);
      const double value[] = {1 + 0.6 * d.x + 0.3 * d.y, 1 + 0.5 * d.y - 0.3 * d.z * d.x, 1 - 0.6 * d.z};
      for (int c = 0; c < 3; ++c) map.level.chart(0).at(x, y)[c] = static_cast<float>(value[c]);
    }
  }
  fill_borders(map);
  return World(std::move(map));
}

/// Root mean square difference between look-ups and paths over a ball, but for its outline, relative to the
/// RMS of the paths' picture; the paths' noise is taken out.
inline double error_of_look_ups(const Material& material, const World& world) {
  constexpr int kSize = 32;
  constexpr double kPart = 0.95;
  const TracedScene scene(ball_of(material));
  const Image picture = render(scene, ball_camera(kSize), world, *make_shading("material", {world}),
                               {.samples = 4, .background = false});
  const PathPicture truth =
      path_trace(scene, ball_camera(kSize), world, {.samples = 256, .depth = 1, .background = false});
  const double radius = kPart * std::tan(std::asin(0.25)) / std::tan(kPi / 6) * kSize / 2;
  double squares = 0, differences = 0;
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      if (std::hypot(x + 0.5 - kSize / 2, y + 0.5 - kSize / 2) > radius) continue;
      for (int c = 0; c < 3; ++c) {
        const double seen = truth.picture.at(x, y)[c], noise = truth.standard_error.at(x, y)[c];
        squares += seen * seen;
        differences += std::pow(picture.at(x, y)[c] - seen, 2) - noise * noise;
      }
    }
  }
  return std::sqrt(std::max(0.0, differences) / squares);
}

}  // namespace welkin::scene
