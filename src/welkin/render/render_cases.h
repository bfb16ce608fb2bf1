#pragma once

#include <cmath>
#include <string_view>

#include "welkin/render/render.h"
#include "welkin/scene/shapes.h"
#include "welkin/synth/render_synth.h"

/// Scenes and worlds of the tests.
namespace welkin::scene {

/// A white ball of radius 1 at the origin.
inline Scene ball(int rows) {
  Scene scene;
  scene.materials.emplace_back();
  scene.materials[0].name = "white";
  scene.meshes.push_back(sphere_mesh(rows));
  scene.instances.push_back({"ball", 0, {}, -1});
  return scene;
}

/// A square picture of 60° of a ball, from 4 in front of it.
inline PlacedCamera ball_camera(int size) {
  PlacedCamera placed;
  placed.camera.fov = 60;
  placed.camera.size = {size, size};
  placed.position = {0, 0, -4};
  return placed;
}

/// A built-in map as a lat-long.
inline Map synth_map(std::string_view name, int width = 256) {
  return welkin::render(synth::make(name), sphere::AnyParameterization::make("latlong"), width, width / 2);
}

/// One radiance from everywhere.
inline World even_world(float radiance) {
  Map map(sphere::AnyParameterization::make("latlong"), 32, 16, 3);
  for (int y = -kBorder; y < 16 + kBorder; ++y)
    for (int x = -kBorder; x < 32 + kBorder; ++x)
      for (int c = 0; c < 3; ++c) map.level.chart(0).at(x, y)[c] = radiance;
  return World(std::move(map));
}

/// A ball of one material. Its triangles are small enough that what interpolated normals lose is below 1e-4.
inline Scene ball_of(const Material& material) {
  Scene scene = ball(256);
  scene.materials[0] = material;
  return scene;
}

/// What mirrors perfectly.
inline Material smooth_metal() {
  Material material;
  material.metallic = 1;
  material.roughness = 0;
  return material;
}

/// Root mean square difference over the pixels of ball_camera's picture within a part of the ball's radius,
/// relative to the RMS of `truth`.
inline double relative_error_within(const Image& picture, const Image& truth, double part) {
  const int size = picture.width();
  const double radius = part * std::tan(std::asin(0.25)) / std::tan(kPi / 6) * size / 2;
  double squares = 0, differences = 0;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      if (std::hypot(x + 0.5 - size / 2, y + 0.5 - size / 2) > radius) continue;
      for (int c = 0; c < 3; ++c) {
        squares += std::pow(truth.at(x, y)[c], 2);
        differences += std::pow(picture.at(x, y)[c] - truth.at(x, y)[c], 2);
      }
    }
  }
  return std::sqrt(differences / squares);
}

}  // namespace welkin::scene
