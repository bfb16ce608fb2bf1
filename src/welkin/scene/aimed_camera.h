#pragma once

#include "welkin/base/export.h"
#include "welkin/scene/scene.h"

/// @file
/// Cameras for scenes that have none.
namespace welkin::scene {

/// A camera at `position` that looks at `target`, +Y up in its picture as far as it can be. Throws Error
/// (bad_request) where both are one point, or a field of view isn't within 0 … 180 degrees.
WELKIN_API SceneCamera aimed_camera(const Vec3d& position, const Vec3d& target, double vertical_fov = 45);

/// A camera that sees all of a box, in pictures of that width over height and in wider ones: it stands in the
/// direction `from` of the box's middle, just as far as needed. Throws Error (bad_request) for a direction
/// without length, a field of view outside 0 … 180 degrees, an aspect that isn't over 0.
WELKIN_API SceneCamera camera_seeing(const Bounds& box, const Vec3d& from, double vertical_fov = 35,
                                     double aspect = 16.0 / 9);

}  // namespace welkin::scene
