#pragma once

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

}  // namespace welkin::scene
