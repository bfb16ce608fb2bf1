#pragma once

#include <array>
#include <functional>

#include "welkin/base/export.h"
#include "welkin/scene/scene.h"

/// @file
/// Meshes of known shapes, with normals and texture coordinates.
namespace welkin::scene {

/// A grid of columns × rows quadrilaterals over (u, v) of 0…1 × 0…1, two triangles each, those without area
/// left out. `point` gives the position and the normal at (u, v); seen from the front, u goes right, v down.
struct GridPoint {
  Vec3d position;  ///< of the vertex
  Vec3d normal;    ///< of any length > 0
};
/// Throws Error (bad_request) for less than one column or row, or over 10⁷ of both.
WELKIN_API Mesh grid_mesh(const std::function<GridPoint(double u, double v)>& point, int columns, int rows);

/// A sphere of radius 1 about the origin, the poles at ±Y, seams at −Z, of rows × 2·rows quadrilaterals.
WELKIN_API Mesh sphere_mesh(int rows = 96);

/// A torus about the origin in the plane of X and Z: the ring's radius 1, the tube's `tube`.
WELKIN_API Mesh torus_mesh(double tube = 0.4, int around = 192, int across = 96);

/// A rectangle in the plane of X and Z from −1 to 1, facing +Y.
WELKIN_API Mesh square_mesh(int cells = 1);

/// A box from −1 to 1, its faces flat, outwards.
WELKIN_API Mesh box_mesh();

}  // namespace welkin::scene
