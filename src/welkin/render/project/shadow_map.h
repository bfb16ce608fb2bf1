#pragma once

#include <memory>
#include <span>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/map/map.h"
#include "welkin/render/shading/shading.h"
#include "welkin/render/trace/traced_scene.h"

/// @file
/// Shadows of lights without extent, from distances on the octahedron (Engelhardt & Dachsbacher 2008, §4.1).
namespace welkin::scene {

/// How distances are kept and compared.
struct ShadowMapOptions {
  int size = 1024;  ///< texels along a side, 16 … 16384
  /// Chebyshev's bound from the mean and the mean square of the distances of each texel (Donnelly & Lauritzen
  /// 2006): soft edges, and light that leaks where shadows overlap. Else 2×2 distances are compared, and the
  /// results interpolated.
  bool moments = false;
  /// As a share of the distance: what is so near to something throws no shadow on it. One and a half texels
  /// are added where distances are compared.
  double bias = 1e-3;
};

/// What a light sees all around. Never changes; safe from many threads. Cheap to copy.
class WELKIN_API ShadowMap {
 public:
  /// Traces a ray through every texel's centre, or 16 of each for moments. Throws Error (bad_request) for
  /// options out of range or a position as `project`.
  ShadowMap(const TracedScene& scene, const Vec3d& light, const ShadowMapOptions& options = {});

  /// The share of light that reaches a place whose surface has a normal of unit length, on either side: 0
  /// … 1. A texel's distance is compared with that of the surface's plane in the texel's direction, so a
  /// surface that the light grazes doesn't shadow itself.
  double visibility(const Vec3d& position, const Vec3d& normal) const;

  const Vec3d& light() const { return light_; }   ///< where it is
  const Map& distances() const { return *map_; }  ///< octahedral: Z, or Z and Z2

 private:
  double compared(const Vec3d& from_light, const Vec3d& normal) const;
  double bounded(const Vec3d& from_light) const;

  Vec3d light_;
  ShadowMapOptions options_;
  std::shared_ptr<const Map> map_;
};

/// How a scene's lights throw shadows.
enum class Shadows {
  none,    ///< they don't
  map,     ///< by a ShadowMap of each point and spot light; of a directional one by rays
  traced,  ///< by a ray to the light from each surface
};

/// A shading, and the light of a scene's lights besides: diffuse reflection and GGX of each material (glTF
/// 2.0, appendix B), nothing of what passes through. Keeps what it is given.
WELKIN_API std::unique_ptr<Shading> with_lights(std::unique_ptr<Shading> shading, const TracedScene& scene,
                                                Shadows shadows = Shadows::map,
                                                const ShadowMapOptions& options = {});

}  // namespace welkin::scene
