#pragma once

#include "welkin/base/monitor.h"
#include "welkin/camera/camera.h"
#include "welkin/image/image.h"
#include "welkin/render/world.h"

namespace welkin::scene {

/// Puts the world behind a camera's picture of R G B A, colours multiplied by alpha, which becomes 1 where
/// the lens shows something. Each pixel shows the mean over its area.
void show_behind(Image& picture, const Camera& camera, const World& world, const Monitor& monitor);

}  // namespace welkin::scene
