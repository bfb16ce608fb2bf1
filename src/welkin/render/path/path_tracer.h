#pragma once

#include <cstdint>
#include <string_view>

#include "welkin/base/export.h"
#include "welkin/base/monitor.h"
#include "welkin/image/image.h"
#include "welkin/render/render.h"
#include "welkin/render/trace/traced_scene.h"
#include "welkin/render/world.h"

/// @file
/// Pictures of scenes by following light along paths: what look-ups approximate.
namespace welkin::scene {

/// How paths find the light of the world and of surfaces that glow.
enum class LightSampling {
  mis,    ///< both, weighted by their densities (Veach & Guibas 1995, the balance heuristic)
  bsdf,   ///< in directions in which surfaces scatter
  light,  ///< in directions in which they are bright, but for mirrors
};

/// `mis`, `bsdf`, `light`. Throws Error (bad_request) for another name.
WELKIN_API LightSampling light_sampling_from_name(std::string_view name);
/// The name that light_sampling_from_name takes.
WELKIN_API std::string_view name_of(LightSampling sampling);

/// How paths are followed.
struct PathOptions {
  int samples = 64;  ///< paths of each pixel, 1 … 2²⁰
  int depth = 16;  ///< surfaces at which a path is scattered, at most, 0 … 1000; 0: only what glows is seen
  std::uint64_t seed = 0;                       ///< other pictures of the same mean
  LightSampling sampling = LightSampling::mis;  ///< of light
  /// The most radiance that a path may bring, in any channel; 0: no bound. A bound hides bright dots and
  /// makes pictures too dark.
  double clamp = 0;
  bool background = true;  ///< show the world behind; false: nothing, and alpha 0
  Monitor monitor = {};    ///< progress and cancelling
};

/// A picture and how sure it is.
struct PathPicture {
  Image picture;  ///< R G B A, as of render()
  /// The standard error of each value of `picture`: what the mean of a pixel's paths would spread by if it
  /// was made again with other seeds. From the spread of up to 16 independent batches of paths; of one path
  /// infinite.
  Image standard_error;
};

/// R G B A of a scene as a camera sees it, like render(), by paths through all of it: reflected, refracted
/// and scattered among surfaces as their materials say (GGX, Lambert under it, clear coat, rough glass with
/// Walter et al. 2007's facets; sheen is left out), lit by the world's map, by point, spot and directional
/// lights, and by surfaces that glow. Refraction goes through bodies: a
/// surface's back is the inside. Pixels are box-filtered.
///
/// Shading has no bias but the path's largest depth, the world's texels interpolated, and normals
/// interpolated across triangles: what these scatter behind the triangle's plane is lost, (1 − cos δ)/2 of
/// diffuse light where they differ by δ. The world's light is found by the map's brightness only where its
/// proxy is `far`; with another, `mis` means `bsdf`.
///
/// The same bits for any number of threads. Throws Error (bad_request): options out of range, `light` of a
/// world with a proxy, and as frame_of does; (bad_value) where texels are not finite; Cancelled.
WELKIN_API PathPicture path_trace(const TracedScene& scene, const PlacedCamera& camera, const World& world,
                                  const PathOptions& options = {});

}  // namespace welkin::scene
