#pragma once

#include <optional>

#include "welkin/base/export.h"
#include "welkin/base/monitor.h"
#include "welkin/map/map.h"
#include "welkin/render/shading/shading.h"
#include "welkin/render/trace/traced_scene.h"

/// @file
/// World projections: what a place in a scene sees all around, as a map (Greene 1986).
namespace welkin::scene {

/// A scene and what it looks like; refers to what must outlive it.
struct ShadedScene {
  const TracedScene& scene;           ///< what rays meet
  const Shading& shading;             ///< what surfaces send towards the place
  const World* background = nullptr;  ///< what is seen past all surfaces; none: black
};

/// What of the distances is kept.
enum class DepthChannels {
  none,     ///< nothing
  mean,     ///< `Z`: their mean
  moments,  ///< `Z`, and `Z2`: the mean of their squares
};

/// How a world is projected.
struct ProjectOptions {
  int samples = 4;  ///< samples² rays for each texel, 1 … 64
  /// Shade what a texel's rays meet of one opaque instance, where normals differ by less than 26° and
  /// distances by less than a quarter, once, over the cone of the texel, and not ray by ray: faster, and a
  /// little less exact where light changes within a texel.
  bool shade_once = false;
  bool coverage = false;  ///< a channel `A`, the share of each texel that surfaces cover
  /// Distances along the rays, in the scene's lengths, not depths along an axis.
  DepthChannels depth = DepthChannels::none;
  /// Distances count as this at most, and those of rays that meet nothing do. None: farthest_distance.
  std::optional<double> farthest = {};
  Monitor monitor = {};  ///< progress and cancelling
};

/// From a place to the farthest corner of the scene's bounds; 1 of a scene without triangles.
WELKIN_API double farthest_distance(const Scene& scene, const Vec3d& position);

/// The world as `position` sees it, straight into charts of any parameterization: R G B, radiance, then what
/// the options ask for. Every texel is the mean over its solid angle, by rays at the positions of
/// synth's `render`, each weighted by its density; positions that aren't valid don't count, and texels whose
/// centre isn't are 0. Where no surface is seen, the background's mean over the texel (resample); beside
/// surfaces its mean over each ray's cone. Surfaces are seen from both sides, and through those with alpha
/// what is behind them, to 32 layers. Borders are filled. The same bits for any number of threads. Throws
/// Error (bad_request): options out of range, a position that isn't finite or beyond 1e30, and as Map does;
/// Cancelled.
WELKIN_API Map project(const ShadedScene& seen, const Vec3d& position, const MapFrame& to,
                       const ProjectOptions& options = {});

}  // namespace welkin::scene
