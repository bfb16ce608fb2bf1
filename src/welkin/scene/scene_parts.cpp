#include "welkin/scene/scene_parts.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace welkin::scene {

int add_material(Scene& scene, Material material) {
  scene.materials.push_back(std::move(material));
  return static_cast<int>(scene.materials.size()) - 1;
}

int add_mesh(Scene& scene, Mesh mesh, std::string name, int material) {
  mesh.name = std::move(name);
  mesh.material = material;
  scene.meshes.push_back(std::move(mesh));
  return static_cast<int>(scene.meshes.size()) - 1;
}

void add_instance(Scene& scene, std::string name, int mesh, const Transform& to_world, int material) {
  scene.instances.push_back({std::move(name), mesh, to_world, material});
}

void add_object(Scene& scene, Mesh mesh, const std::string& name, int material, const Transform& to_world) {
  add_instance(scene, name, add_mesh(scene, std::move(mesh), name, material), to_world);
}

Transform placed(const Vec3d& origin, const Vec3d& scale, double yaw) {
  const Matrix3 stretch{{{{scale.x, 0, 0}, {0, scale.y, 0}, {0, 0, scale.z}}}};
  return {rotation_from_yaw_pitch_roll(yaw, 0, 0) * stretch, origin};
}

Material metal(std::string name, std::array<float, 3> color, float roughness) {
  Material material;
  material.name = std::move(name);
  material.base_color = color;
  material.metallic = 1;
  material.roughness = roughness;
  return material;
}

Material paint(std::string name, std::array<float, 3> color, float roughness) {
  Material material;
  material.name = std::move(name);
  material.base_color = color;
  material.roughness = roughness;
  return material;
}

int rows_for(double triangles, double columns_per_row, int least) {
  return std::max(least,
                  static_cast<int>(std::lround(std::sqrt(std::max(triangles, 0.0) / (2 * columns_per_row)))));
}

}  // namespace welkin::scene
