#pragma once

#include <array>
#include <functional>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/image/image.h"
#include "welkin/math/rotation.h"
#include "welkin/math/vec.h"

/// @file
/// Maps of what a ball shows from a few directions, warped to the present one (Cabral, Olano & Nemec 1999).
namespace welkin::scene {

/// What a ball of some material shows to a viewer at infinity: made, or photographed.
struct ViewMap {
  Matrix3 to_eye = {};  ///< from the world to the viewer's frame: x right, y up, z towards the viewer
  /// A square picture of the ball, R G B, its disc filling the square: the normal (x, y) lies at ((1 + x)/2,
  /// (1 − y)/2).
  Image picture;
};

/// The frame of a viewer in a direction, upright.
WELKIN_API Matrix3 eye_towards(const Vec3d& view);

/// `count` directions spread evenly over the sphere, 3 … 1000 (a spiral of golden angles).
WELKIN_API std::vector<Vec3d> even_directions(int count);

/// A map of `size` texels a side for each direction of view, by a function of normal and view, unit vectors
/// of the world. Outside the disc the rim goes on. Called from many threads at once.
WELKIN_API std::vector<ViewMap> view_maps(
    const std::vector<Vec3d>& views, int size,
    const std::function<std::array<float, 3>(const Vec3d& normal, const Vec3d& view)>& shown);

/// Looks view maps up for any view: the three nearest, each at the normal that would reflect to its viewer
/// what the present one sees reflected, blended by how near they are. Right for mirrors seen from the maps'
/// directions; wrong where light leaves in other ways than about the reflected direction, as from diffuse and
/// retro-reflecting surfaces, and by what n·v does to the material, which differs between the two normals.
class WELKIN_API WarpedViews {
 public:
  /// Throws Error (bad_request) for fewer than three maps, pictures that aren't square or have fewer than
  /// three channels, frames that aren't orthonormal.
  explicit WarpedViews(std::vector<ViewMap> maps);

  /// Radiance towards the viewer; both are unit vectors of the world.
  std::array<float, 3> rgb(const Vec3d& normal, const Vec3d& view) const;

 private:
  std::vector<ViewMap> maps_;
};

}  // namespace welkin::scene
