#pragma once

#include <array>
#include <cmath>

#include "welkin/assemble/ball_photograph.h"
#include "welkin/map/borders.h"
#include "welkin/math/angles.h"
#include "welkin/synth/synth.h"

/// A photograph of a mirror ball, made as light makes it: rays of a camera meet a sphere of radius 1 and are
/// reflected. What the tests of unwrapping compare with; it shares no formula with sphere/mirror_ball.h.
namespace welkin {

struct BallShot {
  int width = 200, height = 200;
  PictureCircle circle{100, 100, 100};
  double distance = 20;
  Look look = {};
  double camera = 0;      ///< half angle of the black cone around the camera, as the ball shows it
  double background = 0;  ///< radiance beside the ball
  double gain = 1;
};

inline std::array<double, 3> radiance_of(const synth::Radiance& world, const BallShot& shot,
                                         const Vec3d& ray) {
  // In the camera's frame: it is at the origin and looks along +Z to the centre of the ball.
  const Vec3d centre{0, 0, shot.distance};
  const double along = dot(ray, centre);
  const double discriminant = along * along - (shot.distance * shot.distance - 1);
  if (discriminant <= 0) return {shot.background, shot.background, shot.background};
  const Vec3d normal = (along - std::sqrt(discriminant)) * ray - centre;
  const Vec3d reflected = ray - (2 * dot(ray, normal)) * normal;
  if (angle_between(reflected, {0, 0, -1}) < shot.camera * kDegree) return {0, 0, 0};
  const std::array<float, 3> seen = world(normalize(rotation_of(shot.look) * reflected));
  return {shot.gain * static_cast<double>(seen[0]), shot.gain * static_cast<double>(seen[1]),
          shot.gain * static_cast<double>(seen[2])};
}

inline Map photograph(const synth::Radiance& world, const BallShot& shot) {
  constexpr int kSamples = 4;
  // The picture's plane at distance 1: the outline is where rays touch the ball.
  const double outline = 1 / std::sqrt(shot.distance * shot.distance - 1);
  Map map(sphere::AnyParameterization::make("latlong"), shot.width, shot.height, 3);
  for (int y = 0; y < shot.height; ++y) {
    for (int x = 0; x < shot.width; ++x) {
      std::array<double, 3> sum{};
      for (int i = 0; i < kSamples * kSamples; ++i) {
        const double right = (x + (i % kSamples + 0.5) / kSamples - shot.circle.x) / shot.circle.radius,
                     down = (y + (i / kSamples + 0.5) / kSamples - shot.circle.y) / shot.circle.radius;
        const std::array<double, 3> seen =
            radiance_of(world, shot, normalize(Vec3d{-outline * right, -outline * down, 1}));
        for (std::size_t c = 0; c < 3; ++c) sum[c] += seen[c] / (kSamples * kSamples);
      }
      for (std::size_t c = 0; c < 3; ++c) map.level.chart(0).at(x, y)[c] = static_cast<float>(sum[c]);
    }
  }
  fill_borders(map);
  return map;
}

/// Bands of a few tens of degrees.
inline std::array<float, 3> ball_world(const Vec3d& d) {
  return {static_cast<float>(1 + 0.5 * std::sin(5 * d.x + 2 * d.y)), static_cast<float>(1.2 + d.y),
          static_cast<float>(0.8 + 0.4 * std::cos(4 * d.z))};
}

inline BallPiece piece_of(const synth::Radiance& world, const BallShot& shot, double camera = 0) {
  BallPhotographOptions options;
  options.look = shot.look;
  options.distance = shot.distance;
  options.circle = shot.circle;
  options.camera = camera;
  return make_ball_piece("ball", photograph(world, shot), options);
}

}  // namespace welkin
