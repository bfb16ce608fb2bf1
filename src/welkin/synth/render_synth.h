#pragma once

#include "welkin/base/export.h"
#include "welkin/base/monitor.h"
#include "welkin/map/map.h"
#include "welkin/synth/synth.h"

/// @file
/// Maps of functions of direction.
namespace welkin {

/// How a map of a function is made.
struct RenderOptions {
  int samples = 4;           ///< samples² per texel, 1 … 64
  Matrix3 orientation = {};  ///< of the map, as Map::orientation
  Monitor monitor = {};      ///< progress and cancelling
};

/// A map (R, G, B) of a function of direction: every texel is the mean over its solid angle, from samples²
/// positions spread so that no two share a row or column of the texel (Chiu, Shirley & Wang, "Multi-jittered
/// sampling", 1994, fig. 2, without the jitter), each weighted by its density; the same in every run.
/// `radiance` is called from many threads at once, along unit directions of the world. Positions that aren't
/// valid don't count, and texels whose centre isn't are 0. Borders are filled. Directions are
/// exact to 1e-6. Throws Error (bad_request) for sizes and samples out of range, for an orientation that
/// isn't orthonormal, and Cancelled.
WELKIN_API Map render(const synth::Radiance& radiance, const sphere::AnyParameterization& parameterization,
                      int width, int height, const RenderOptions& options = {});

}  // namespace welkin
