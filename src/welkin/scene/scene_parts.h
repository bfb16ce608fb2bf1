#pragma once

#include <string>

#include "welkin/scene/scene.h"

/// @file
/// What the built-in scenes are put together of.
namespace welkin::scene {

/// The scenes that have a file of their own. `triangles`: about so many in all.
/// @{
Scene make_teapot(int triangles);
Scene make_room(int triangles);
Scene make_landscape(int triangles);
Scene make_creature(int triangles);
/// @}

/// Parts of the teapot, standing on the plane y = 0, about 3.3 wide and 1.6 high.
void add_teapot(Scene& scene, const Transform& to_world, int material, int triangles);

/// Adds a material, and gives its number.
int add_material(Scene& scene, Material material);
/// Adds a mesh of that name and material, and gives its number.
int add_mesh(Scene& scene, Mesh mesh, std::string name, int material);
/// Adds an instance.
void add_instance(Scene& scene, std::string name, int mesh, const Transform& to_world, int material = -1);
/// Adds a mesh that is seen once.
void add_object(Scene& scene, Mesh mesh, const std::string& name, int material,
                const Transform& to_world = {});

/// Scaled along its axes, then turned about +Y by degrees, then moved.
Transform placed(const Vec3d& origin, const Vec3d& scale = {1, 1, 1}, double yaw = 0);

/// The colours and roughness of common stuff.
/// @{
Material metal(std::string name, std::array<float, 3> color, float roughness);
Material paint(std::string name, std::array<float, 3> color, float roughness = 0.8f);
/// @}

/// Rows of quadrilaterals so that rows × (columns_per_row · rows) have about so many triangles, from `least`.
int rows_for(double triangles, double columns_per_row, int least);

}  // namespace welkin::scene
