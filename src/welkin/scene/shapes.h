#pragma once

#include <array>
#include <functional>
#include <vector>

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

/// A smooth curve through points, at even steps of t = 0…1 (Catmull & Rom 1974, uniform). Throws Error
/// (bad_request) for less than two points.
WELKIN_API std::function<Vec3d(double t)> curve_through(std::vector<Vec3d> points);

/// The outline of a body of rotation at t = 0…1. The body lies to the left of it as t grows, the axis on the
/// left and its end up: from the bottom to the top outside, from the top to the bottom inside a hollow.
struct ProfilePoint {
  double along;   ///< on the axis
  double radius;  ///< from the axis, ≥ 0
};
/// That outline; smooth wherever normals shall be.
using Profile = std::function<ProfilePoint(double t)>;

/// The profile of a rod of that length with half spheres at its ends, whose radius runs from `first` to
/// `last`; both over 0.
WELKIN_API Profile rod_profile(double length, double first, double last);

/// A body of rotation about Y, which is closed where its profile begins and ends on the axis; columns ×
/// `rows` quadrilaterals.
WELKIN_API Mesh lathe_mesh(const Profile& profile, int columns = 96, int rows = 96);

/// The same about a curved axis: `along` is length on the curve, which goes on straight past its ends. The
/// curve moves wherever t does; the radius is less than that of its bends.
WELKIN_API Mesh tube_mesh(const std::function<Vec3d(double t)>& axis, const Profile& profile,
                          int columns = 48, int rows = 192);
/// Length of a curve, to about 1e-5 of it.
WELKIN_API double curve_length(const std::function<Vec3d(double t)>& curve);

/// The surface where a function of position is 0: outside it is positive, inside negative, and it changes by
/// at most as much as position moves. `cells` cubes lie along the box's longest side, 4 … 2048; the surface
/// lies inside the box by one of them at least. Normals are the function's gradient. (Gibson 1998, surface
/// nets, whose vertices are then moved onto the surface.) The function is called from many threads at once.
WELKIN_API Mesh implicit_mesh(const std::function<double(const Vec3d& p)>& distance, const Bounds& box,
                              int cells);

}  // namespace welkin::scene
