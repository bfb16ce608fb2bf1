// A scene of one's own: a vase from an outline, a wire along a curve, and a camera that sees both. With a
// file's name: what is in that scene.
#include <welkin/scene/aimed_camera.h>
#include <welkin/scene/read_scene.h>
#include <welkin/scene/shapes.h>

#include <cmath>
#include <cstdio>

namespace scene = welkin::scene;

scene::Scene vase_and_wire() {
  scene::Scene made;
  scene::Material glaze{.name = "glaze", .base_color = {0.1f, 0.3f, 0.2f}, .roughness = 0.5f, .clearcoat = 1};
  scene::Material copper{
      .name = "copper", .base_color = {0.95f, 0.64f, 0.54f}, .metallic = 1, .roughness = 0.1f};
  made.materials = {glaze, copper};

  // From the bottom of the axis up outside, over the rim, and down inside to the axis.
  const auto outline = scene::curve_through({{0, 0, 0},
                                             {0, 0.4, 0},
                                             {0.5, 0.6, 0},
                                             {1.2, 0.3, 0},
                                             {1.5, 0.4, 0},
                                             {1.2, 0.25, 0},
                                             {0.4, 0.4, 0},
                                             {0.2, 0, 0}});
  made.meshes.push_back(scene::lathe_mesh([&](double t) {
    const welkin::Vec3d at = outline(t);
    return scene::ProfilePoint{at.x, std::fmax(at.y, 0)};
  }));

  const auto spiral = [](double t) { return welkin::Vec3d{std::cos(20 * t), 1.5 * t, std::sin(20 * t)}; };
  made.meshes.push_back(
      scene::tube_mesh(spiral, scene::rod_profile(scene::curve_length(spiral), 0.05, 0.02), 16, 600));
  made.meshes[1].material = 1;

  made.instances = {{.name = "vase", .mesh = 0}, {.name = "wire", .mesh = 1}};
  made.cameras.push_back(scene::camera_seeing(*scene::bounds_of(made), {1, 0.5, 1}));
  made.check();
  return made;
}

int main(int argc, char** argv) try {
  const scene::Scene shown = argc > 1 ? scene::read_scene(argv[1]) : vase_and_wire();
  std::printf(
      "%llu triangles in %zu instances of %zu meshes, %zu materials, %zu pictures, %zu cameras, %zu lights\n",
      static_cast<unsigned long long>(scene::triangle_count(shown)), shown.instances.size(),
      shown.meshes.size(), shown.materials.size(), shown.pictures.size(), shown.cameras.size(),
      shown.lights.size());
  for (const std::string& warning : shown.warnings) std::printf("warning: %s\n", warning.c_str());
} catch (const std::exception& error) {
  std::fprintf(stderr, "own_scene: %s\n", error.what());
  return 1;
}
