#include "welkin/scene/built_in.h"

#include <array>

#include "welkin/base/error.h"
#include "welkin/scene/aimed_camera.h"
#include "welkin/scene/scene_parts.h"
#include "welkin/scene/shapes.h"

namespace welkin::scene {
namespace {

int or_else(int triangles, int usual) {
  return triangles > 0 ? triangles : usual;
}

Mesh sphere_of(double triangles) {
  return sphere_mesh(rows_for(triangles, 2, 4));
}

Mesh torus_of(double tube, double triangles) {
  const int across = rows_for(triangles, 2, 4);
  return torus_mesh(tube, 2 * across, across);
}

void add_camera(Scene& scene, const Vec3d& from, double aspect) {
  scene.cameras.push_back(camera_seeing(*bounds_of(scene), from, 35, aspect));
}

Scene make_sphere(int triangles) {
  Scene scene;
  const int material = add_material(scene, metal("metal", {0.95f, 0.93f, 0.88f}, 0.15f));
  add_object(scene, sphere_of(or_else(triangles, 40'000)), "sphere", material);
  add_camera(scene, {0, 0, 1}, 1);
  return scene;
}

Scene make_spheres(int triangles) {
  Scene scene;
  constexpr int kCount = 7;
  const int mesh =
      add_mesh(scene, sphere_of(or_else(triangles, 140'000) / static_cast<double>(kCount)), "sphere", 0);
  for (int i = 0; i < kCount; ++i) {
    // Of ior 1 nothing but the metallic share is reflected: diffuse and mirror in proportion.
    const float share = static_cast<float>(i) / (kCount - 1);
    Material material = metal("metallic " + std::to_string(i) + "/6", {0.9f, 0.88f, 0.85f}, 0);
    material.metallic = share;
    material.ior = 1;
    const std::string name = "sphere " + std::to_string(i + 1);
    add_instance(scene, name, mesh, placed({2.3 * (i - 3), 0, 0}), add_material(scene, std::move(material)));
  }
  add_camera(scene, {0, 0.12, 1}, 16.0 / 9);
  return scene;
}

Scene make_torus(int triangles) {
  Scene scene;
  const int material = add_material(scene, metal("gold", {1, 0.78f, 0.34f}, 0.25f));
  add_object(scene, torus_of(0.42, or_else(triangles, 40'000)), "torus", material);
  add_camera(scene, {0.15, 0.75, 1}, 4.0 / 3);
  return scene;
}

Scene make_floor(int triangles) {
  Scene scene;
  const double each = or_else(triangles, 60'000) / 2.0;
  const int mirror = add_material(scene, metal("mirror", {0.95f, 0.95f, 0.95f}, 0));
  const int red = add_material(scene, paint("red paint", {0.6f, 0.06f, 0.04f}, 0.5f));
  const int copper = add_material(scene, metal("copper", {0.95f, 0.64f, 0.54f}, 0.1f));
  add_object(scene, square_mesh(), "floor", mirror, placed({0, 0, 0}, {4, 1, 4}));
  add_object(scene, sphere_of(each), "sphere", red, placed({-1.25, 1, -0.4}));
  const Transform standing{rotation_from_yaw_pitch_roll(-30, 90, 0), {1.35, 1.35, -0.2}};
  add_object(scene, torus_of(0.35, each), "torus", copper, standing);
  add_camera(scene, {0.1, 0.45, 1}, 16.0 / 9);
  return scene;
}

struct Entry {
  const char* name;
  const char* description;
  Scene (*make)(int triangles);
};

constexpr Entry kScenes[] = {
    {"sphere", "a glossy ball of metal", make_sphere},
    {"spheres", "seven balls, from fully diffuse to a mirror", make_spheres},
    {"torus", "a glossy ring of gold, which mirrors itself", make_torus},
    {"teapot", "a glazed teapot with handle and spout", make_teapot},
    {"floor", "a mirror floor with a ball and a ring on it: near things that a map of far ones doesn't have",
     make_floor},
    {"room", "a closed room with coloured walls, a lamp under its ceiling and a few things, seen from inside",
     make_room},
    {"landscape", "hills, a lake, mountains and trees around a meadow", make_landscape},
    {"creature", "a mirroring animal of six legs, smooth all over", make_creature},
};

const Entry& find(std::string_view name) {
  for (const Entry& entry : kScenes) {
    if (entry.name == name) return entry;
  }
  throw Error(ErrorKind::bad_request, unknown_name("built-in scene", name, built_in_names()));
}

}  // namespace

std::vector<std::string> built_in_names() {
  std::vector<std::string> all;
  for (const Entry& entry : kScenes) all.emplace_back(entry.name);
  return all;
}

std::string built_in_description(std::string_view name) {
  return find(name).description;
}

Scene built_in(std::string_view name, const BuiltInOptions& options) {
  const Entry& entry = find(name);
  require(options.triangles == 0 || (options.triangles >= 64 && options.triangles <= 10'000'000),
          "a built-in scene has 64 to 10,000,000 triangles");
  return entry.make(options.triangles);
}

}  // namespace welkin::scene
