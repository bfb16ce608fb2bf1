#include <algorithm>

#include "welkin/scene/aimed_camera.h"
#include "welkin/scene/scene_parts.h"
#include "welkin/scene/shapes.h"

namespace welkin::scene {
namespace {

/// A profile through (radius, along), from the bottom of the axis to its top.
Profile profile_through(const std::vector<std::array<double, 2>>& points) {
  std::vector<Vec3d> line;
  for (const auto& [radius, along] : points) line.push_back({along, radius, 0});
  return [curve = curve_through(std::move(line))](double t) {
    const Vec3d at = curve(t);
    return ProfilePoint{at.x, std::max(at.y, 0.0)};
  };
}

Mesh body_mesh(int rows) {
  return lathe_mesh(profile_through({{0, 0.02},
                                     {0.25, 0.02},
                                     {0.48, 0.01},
                                     {0.64, 0.04},
                                     {0.79, 0.14},
                                     {0.91, 0.29},
                                     {0.985, 0.48},
                                     {1, 0.66},
                                     {0.94, 0.84},
                                     {0.82, 0.98},
                                     {0.73, 1.06},
                                     {0.69, 1.12},
                                     {0.71, 1.16},
                                     {0.68, 1.18},
                                     {0.64, 1.15},
                                     {0.6, 1.1},
                                     {0.3, 1.08},
                                     {0, 1.08}}),
                    2 * rows, rows);
}

Mesh lid_mesh(int rows) {
  return lathe_mesh(profile_through({{0, 1.09},
                                     {0.3, 1.09},
                                     {0.57, 1.1},
                                     {0.62, 1.14},
                                     {0.6, 1.18},
                                     {0.5, 1.24},
                                     {0.34, 1.29},
                                     {0.18, 1.33},
                                     {0.1, 1.375},
                                     {0.09, 1.42},
                                     {0.14, 1.46},
                                     {0.17, 1.51},
                                     {0.155, 1.56},
                                     {0.09, 1.595},
                                     {0, 1.605}}),
                    2 * rows, rows);
}

/// Open at its mouth: the profile turns inwards there, and ends on the axis inside the spout.
Mesh spout_mesh(int rows) {
  const auto axis = curve_through(
      {{0.72, 0.36, 0}, {0.98, 0.42, 0}, {1.22, 0.55, 0}, {1.37, 0.78, 0}, {1.5, 1.0, 0}, {1.7, 1.13, 0}});
  const double end = curve_length(axis);
  return tube_mesh(axis,
                   profile_through({{0, 0},
                                    {0.15, 0.01},
                                    {0.25, 0.08},
                                    {0.26, 0.25},
                                    {0.215, 0.5},
                                    {0.165, 0.75},
                                    {0.135, 0.95},
                                    {0.12, end - 0.1},
                                    {0.12, end - 0.02},
                                    {0.11, end},
                                    {0.098, end - 0.02},
                                    {0.09, end - 0.15},
                                    {0.09, end - 0.4},
                                    {0.06, end - 0.55},
                                    {0, end - 0.57}}),
                   rows / 2, 2 * rows);
}

Mesh handle_mesh(int rows) {
  const auto axis = curve_through({{-0.8, 0.9, 0},
                                   {-1.05, 0.99, 0},
                                   {-1.32, 0.97, 0},
                                   {-1.47, 0.8, 0},
                                   {-1.42, 0.58, 0},
                                   {-1.22, 0.4, 0},
                                   {-0.88, 0.3, 0}});
  return tube_mesh(axis, rod_profile(curve_length(axis), 0.085, 0.07), rows / 2, 2 * rows);
}

}  // namespace

void add_teapot(Scene& scene, const Transform& to_world, int material, int triangles) {
  const double all = triangles;
  add_object(scene, body_mesh(rows_for(0.4 * all, 2, 12)), "teapot: body", material, to_world);
  add_object(scene, lid_mesh(rows_for(0.2 * all, 2, 10)), "teapot: lid", material, to_world);
  add_object(scene, spout_mesh(rows_for(0.2 * all, 1, 12)), "teapot: spout", material, to_world);
  add_object(scene, handle_mesh(rows_for(0.2 * all, 1, 12)), "teapot: handle", material, to_world);
}

Scene make_teapot(int triangles) {
  Scene scene;
  Material glaze = paint("glaze", {0.07f, 0.2f, 0.42f}, 0.6f);
  glaze.clearcoat = 1;
  glaze.clearcoat_roughness = 0.03f;
  add_teapot(scene, {}, add_material(scene, std::move(glaze)), triangles > 0 ? triangles : 60'000);
  scene.cameras.push_back(camera_seeing(*bounds_of(scene), {0.35, 0.35, 1}, 35, 16.0 / 9));
  return scene;
}

}  // namespace welkin::scene
