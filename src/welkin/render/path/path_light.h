#pragma once

#include <optional>

#include "welkin/light/importance.h"
#include "welkin/render/path/path_numbers.h"
#include "welkin/render/path/path_tracer.h"
#include "welkin/render/radiance.h"
#include "welkin/render/world.h"

namespace welkin::scene {

/// A direction from which light comes, and how likely it was drawn.
struct DrawnLight {
  Vec3d direction;
  Radiance radiance;
  double pdf;
};

/// The world as paths see it.
class PathLight {
 public:
  PathLight(const World& world, LightSampling sampling, const Monitor& monitor);

  /// Radiance from `position` along a direction.
  Radiance seen(const Vec3d& position, const Vec3d& direction) const;
  /// Whether directions are drawn where it is bright.
  bool is_drawn() const { return importance_.has_value(); }
  /// One of them; none where it would bring nothing.
  std::optional<DrawnLight> draw(const Vec3d& position, PathNumbers& numbers) const;
  /// What a direction that was drawn by the light counts, `pdf` its density and `bsdf` that of the surface.
  double light_weight(double pdf, double bsdf) const;
  /// What a direction that was drawn by the surface counts.
  double surface_weight(const Vec3d& direction, double bsdf) const;

 private:
  World world_;
  LightSampling sampling_;  // of the world
  LightSampling wanted_;    // of what is near
  std::optional<ImportanceSampler> importance_;
};

/// What a lamp of the scene sends to a place.
struct LampLight {
  Vec3d direction;      ///< towards it
  double distance;      ///< to it; infinite of directional ones
  Radiance irradiance;  ///< across the direction
};
/// None where it doesn't shine.
std::optional<LampLight> lamp_at(const PointLight& lamp, const Vec3d& position);

}  // namespace welkin::scene
