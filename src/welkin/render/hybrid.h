#pragma once

#include "welkin/base/export.h"
#include "welkin/base/monitor.h"
#include "welkin/image/image.h"
#include "welkin/render/render.h"
#include "welkin/render/shading/shading.h"
#include "welkin/render/trace/traced_scene.h"

/// @file
/// Pictures of scenes whose mirrors show what is near by rays, and what is far by maps.
namespace welkin::scene {

/// How mirrored and refracted rays are followed.
struct HybridOptions {
  int samples = 4;         ///< rays of each pixel along each axis, 1 … 64
  int depth = 8;           ///< surfaces behind one another at which rays go on, 0 … 100
  double smooth = 0.1;     ///< the largest roughness of surfaces that mirror by rays, 0 … 1
  bool background = true;  ///< show the world behind; false: nothing, and alpha 0
  Monitor monitor = {};    ///< progress and cancelling
};

/// R G B A as of render(): a local model, traced, with the map as what is far away (Greene 1986, §"Ray
/// tracing"). Where a surface's roughness is at most `smooth`, the rays that it reflects and, where it
/// transmits, refracts are traced among the scene's surfaces, bounce after bounce; those that meet nothing
/// look the map up over their pixel's cone, which grows as it goes along. Surfaces that are rougher, and what
/// lies under smooth ones, are shaded by look-ups, as if nothing stood around them: `shading` those, diffuse
/// light these. Beyond `depth` surfaces `shading` shades all.
///
/// Reflectances are as of path_trace, but radiance isn't compressed inside glass. Rays of less than 0.2 % of
/// a pixel's light look the map up at once. The same bits for any number of threads. Throws Error
/// (bad_request) for options out of range, and as frame_of does; Cancelled.
WELKIN_API Image render_hybrid(const TracedScene& scene, const PlacedCamera& camera, const Worlds& worlds,
                               const Shading& shading, const HybridOptions& options = {});

}  // namespace welkin::scene
