#pragma once

#include "welkin/base/export.h"
#include "welkin/base/monitor.h"
#include "welkin/image/image.h"
#include "welkin/render/render.h"
#include "welkin/render/world.h"

/// @file
/// What is seen behind a scene.
namespace welkin::scene {

/// Puts the world behind a camera's picture of R G B A, colours multiplied by alpha, as render() makes it
/// without a background: alpha becomes 1 where the lens shows something. Each pixel shows the mean over its
/// area; of a world with a proxy, the world as the camera's place sees it, over the pixel's cone. Throws
/// Error (mismatch) for a picture of another size or without four channels; as frame_of does; Cancelled.
WELKIN_API void show_behind(Image& picture, const PlacedCamera& camera, const World& world,
                            const Monitor& monitor = {});

}  // namespace welkin::scene
