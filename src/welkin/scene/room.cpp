#include "welkin/scene/aimed_camera.h"
#include "welkin/scene/scene_parts.h"
#include "welkin/scene/shapes.h"

namespace welkin::scene {
namespace {

// A room of 5 × 3 × 6, the floor at y = 0.
constexpr double kWide = 2.5, kHigh = 3, kDeep = 3;

/// The wall that a square (facing +Y) becomes: turned, stretched, moved.
Transform wall(const Matrix3& turn, const Vec3d& stretch, const Vec3d& middle) {
  return {turn * placed({}, stretch).linear, middle};
}

void add_walls(Scene& scene) {
  const int white = add_material(scene, paint("white wall", {0.75f, 0.74f, 0.71f}));
  const int red = add_material(scene, paint("red wall", {0.62f, 0.08f, 0.06f}));
  const int green = add_material(scene, paint("green wall", {0.12f, 0.42f, 0.1f}));
  const int blue = add_material(scene, paint("blue wall", {0.14f, 0.22f, 0.5f}));
  const int wood = add_material(scene, paint("wooden floor", {0.32f, 0.19f, 0.1f}, 0.35f));
  const int square = add_mesh(scene, square_mesh(8), "wall", white);
  const auto turned = [](double pitch, double roll) { return rotation_from_yaw_pitch_roll(0, pitch, roll); };
  add_instance(scene, "floor", square, wall(turned(0, 0), {kWide, 1, kDeep}, {0, 0, 0}), wood);
  add_instance(scene, "ceiling", square, wall(turned(180, 0), {kWide, 1, kDeep}, {0, kHigh, 0}));
  add_instance(scene, "back wall", square,
               wall(turned(90, 0), {kWide, 1, kHigh / 2}, {0, kHigh / 2, -kDeep}));
  add_instance(scene, "front wall", square,
               wall(turned(-90, 0), {kWide, 1, kHigh / 2}, {0, kHigh / 2, kDeep}), blue);
  add_instance(scene, "left wall", square,
               wall(turned(0, -90), {kHigh / 2, 1, kDeep}, {-kWide, kHigh / 2, 0}), red);
  add_instance(scene, "right wall", square, wall(turned(0, 90), {kHigh / 2, 1, kDeep}, {kWide, kHigh / 2, 0}),
               green);
}

void add_lamp(Scene& scene) {
  Material light = paint("lamp", {0.8f, 0.8f, 0.8f});
  light.emission = {18, 16, 12.5f};
  add_object(scene, box_mesh(), "lamp", add_material(scene, std::move(light)),
             placed({0, kHigh - 0.04, -0.4}, {0.8, 0.03, 0.5}));
}

void add_table(Scene& scene, const Vec3d& at) {
  const int oak = add_material(scene, paint("oak", {0.45f, 0.3f, 0.16f}, 0.4f));
  const int box = add_mesh(scene, box_mesh(), "box", oak);
  add_instance(scene, "table top", box, placed(at + Vec3d{0, 0.76, 0}, {0.8, 0.03, 0.5}));
  for (const double x : {-0.72, 0.72})
    for (const double z : {-0.42, 0.42})
      add_instance(scene, "table leg", box, placed(at + Vec3d{x, 0.365, z}, {0.035, 0.365, 0.035}));
}

}  // namespace

Scene make_room(int triangles) {
  Scene scene;
  const double each = (triangles > 0 ? triangles : 60'000) / 3.0;
  add_walls(scene);
  add_lamp(scene);
  const Vec3d table{0.75, 0, -1.5};
  add_table(scene, table);
  const int steel = add_material(scene, metal("steel", {0.77f, 0.78f, 0.78f}, 0.05f));
  const int yellow = add_material(scene, paint("yellow plaster", {0.8f, 0.55f, 0.08f}));
  Material glaze = paint("glaze", {0.07f, 0.2f, 0.42f}, 0.6f);
  glaze.clearcoat = 1;
  glaze.clearcoat_roughness = 0.03f;
  const int glazed = add_material(scene, std::move(glaze));
  add_teapot(scene, placed(table + Vec3d{-0.1, 0.79, 0}, {0.27, 0.27, 0.27}, 25), glazed,
             static_cast<int>(each));
  add_object(scene, sphere_mesh(rows_for(each, 2, 4)), "ball", steel,
             placed({-1.2, 0.55, -1.3}, {0.55, 0.55, 0.55}));
  const int across = rows_for(each, 2, 4);
  add_object(scene, torus_mesh(0.35, 2 * across, across), "ring", yellow,
             placed({-0.35, 0.1225, 0.1}, {0.35, 0.35, 0.35}));
  SceneCamera camera = aimed_camera({0, 1.5, kDeep - 0.15}, {0, 1.3, -kDeep}, 58);
  camera.aspect = 4.0 / 3;
  scene.cameras.push_back(std::move(camera));
  return scene;
}

}  // namespace welkin::scene
