#pragma once

#include <functional>
#include <optional>

#include "welkin/base/export.h"
#include "welkin/base/monitor.h"
#include "welkin/camera/camera.h"
#include "welkin/image/image.h"
#include "welkin/render/shading/shading.h"
#include "welkin/render/trace/traced_scene.h"

/// @file
/// Pictures of scenes.
namespace welkin::scene {

/// A camera somewhere.
struct PlacedCamera {
  Camera camera;               ///< lens, size and orientation
  Vec3d position = {0, 0, 0};  ///< in the world
};

/// How a picture is made.
struct RenderOptions {
  int samples = 4;  ///< rays of each pixel along each axis: outlines are antialiased by their square
  Reflection reflection = Reflection::per_pixel;  ///< where reflected directions are found
  bool background = true;                         ///< show the world behind; false: nothing, and alpha 0
  Monitor monitor = {};                           ///< progress and cancelling
};

/// R G B A of a scene as a camera sees it, colours multiplied by alpha, which is the surfaces' coverage, or 1
/// everywhere with a background. Radiance is linear. Pixels that the lens doesn't show are 0. The same bits
/// for any number of threads. Throws Error (bad_request): samples outside 1 … 64, and as frame_of does;
/// Cancelled.
WELKIN_API Image render(const TracedScene& scene, const PlacedCamera& camera, const World& background,
                        const Shading& shading, const RenderOptions& options = {});

/// A camera that sees all of a scene: of the lens and size of `like`, looking along its direction.
WELKIN_API PlacedCamera camera_that_sees(const Scene& scene, const Camera& like);

}  // namespace welkin::scene
