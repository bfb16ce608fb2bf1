#pragma once

#include "welkin/render/project/project.h"
#include "welkin/render/render_cases.h"

/// Scenes that are projected in tests.
namespace welkin::scene {

/// What materials give off, and nothing else.
class EmissionShading : public Shading {
 public:
  void shade(std::span<const Surface> surfaces, std::span<Rgb> radiance) const override {
    for (std::size_t i = 0; i < surfaces.size(); ++i) radiance[i] = surfaces[i].material.emission;
  }
};

/// A smooth function of the direction in which the origin sees a place: 1 + ½(x, y, z).
class DirectionShading : public Shading {
 public:
  void shade(std::span<const Surface> surfaces, std::span<Rgb> radiance) const override {
    for (std::size_t i = 0; i < surfaces.size(); ++i) radiance[i] = of(surfaces[i].position);
  }
  static Rgb of(const Vec3d& direction) {
    const Vec3d d = normalize(direction);
    return {static_cast<float>(1 + 0.5 * d.x), static_cast<float>(1 + 0.5 * d.y),
            static_cast<float>(1 + 0.5 * d.z)};
  }
};

/// The sides of an axis-aligned size, moved.
inline Transform scaled(const Vec3d& size, const Vec3d& origin) {
  return {{{{{size.x, 0, 0}, {0, size.y, 0}, {0, 0, size.z}}}}, origin};
}

/// The mesh seen from the other side.
inline Mesh inside_out(Mesh mesh) {
  for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  for (auto& normal : mesh.normals) normal = -1.0f * normal;
  return mesh;
}

/// A ball about `centre` that gives off one radiance.
inline void add_lamp(Scene& scene, const Vec3d& centre, double radius, float radiance, int rows = 192) {
  Material lamp;
  lamp.name = "lamp";
  lamp.base_color = {0, 0, 0};
  lamp.emission = {radiance, radiance, radiance};
  scene.materials.push_back(lamp);
  Mesh mesh = sphere_mesh(rows);
  mesh.material = static_cast<int>(scene.materials.size()) - 1;
  scene.meshes.push_back(std::move(mesh));
  const Transform to = scaled({radius, radius, radius}, centre);
  scene.instances.push_back({"lamp", static_cast<int>(scene.meshes.size()) - 1, to, -1});
}

/// A grey room, 4×3×6, about the origin, with two boxes and a ball of other colours.
inline Scene furnished_room() {
  Scene scene;
  const std::array<std::array<float, 3>, 4> colours{
      {{0.6f, 0.6f, 0.6f}, {0.9f, 0.2f, 0.1f}, {0.1f, 0.3f, 0.9f}, {0.2f, 0.8f, 0.3f}}};
  for (const auto& colour : colours) {
    scene.materials.emplace_back();
    scene.materials.back().emission = colour;
    scene.materials.back().base_color = colour;
  }
  scene.meshes.push_back(box_mesh());
  scene.meshes.push_back(sphere_mesh(64));
  scene.meshes.push_back(inside_out(box_mesh()));
  const auto add = [&](int mesh, int material, const Vec3d& size, const Vec3d& at) {
    scene.instances.push_back({"", mesh, scaled(size, at), material});
  };
  add(2, 0, {2, 1.5, 3}, {0, 0, 0});
  add(0, 1, {0.4, 0.5, 0.4}, {-1.2, -1, -1.5});
  add(0, 2, {0.3, 0.9, 0.3}, {1.3, -0.6, 1});
  add(1, 3, {0.5, 0.5, 0.5}, {0.9, 0.2, -1.6});
  return scene;
}

}  // namespace welkin::scene
