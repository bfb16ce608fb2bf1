#include <algorithm>
#include <cmath>
#include <optional>

#include "welkin/math/vec_precision.h"
#include "welkin/render/path/bsdf.h"
#include "welkin/render/project/shadow_map.h"

namespace welkin::scene {
namespace {

/// Smoother surfaces are as rough as this, or a point light would have no highlight.
constexpr float kLeastRoughness = 0.03f;

/// What a light sends to a place.
struct Arriving {
  Vec3d towards;    ///< the light, of unit length
  double distance;  ///< infinite of a directional one
  double strength;  ///< irradiance across the way, for each unit of the light's intensity
};

/// Of a spot by its cones (glTF's KHR_lights_punctual).
Arriving arriving(const PointLight& light, const Vec3d& position) {
  if (light.kind == PointLight::Kind::directional)
    return {-1.0 * light.direction, std::numeric_limits<double>::infinity(), 1};
  const Vec3d way = light.position - position;
  const double distance = length(way);
  if (!(distance > 0)) return {{0, 1, 0}, 0, 0};
  const Vec3d towards = (1 / distance) * way;
  double strength = 1 / (distance * distance);
  if (light.kind == PointLight::Kind::spot) {
    const double inner = std::cos(light.inner_cone), outer = std::cos(light.outer_cone),
                 cosine = -dot(towards, light.direction);
    const double part = std::clamp((cosine - outer) / std::max(1e-3, inner - outer), 0.0, 1.0);
    strength *= part * part;
  }
  return {towards, distance, strength};
}

/// A surface as paths scatter light at it.
Bsdf lit_surface(Surface at) {
  at.material.roughness = std::max(kLeastRoughness, at.material.roughness);
  return Bsdf(at);
}

class LightShading : public Shading {
 public:
  LightShading(std::unique_ptr<Shading> under, const TracedScene& scene, Shadows shadows,
               const ShadowMapOptions& options)
      : under_(std::move(under)), scene_(scene), shadows_(shadows) {
    for (const PointLight& light : scene.scene().lights) {
      std::optional<ShadowMap> map;
      if (shadows == Shadows::map && light.kind != PointLight::Kind::directional)
        map.emplace(scene, light.position, options);
      maps_.push_back(std::move(map));
    }
  }

  void shade(std::span<const Surface> surfaces, std::span<Rgb> radiance) const override {
    under_->shade(surfaces, radiance);
    const std::vector<PointLight>& lights = scene_.scene().lights;
    if (lights.empty()) return;
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
      const Surface& at = surfaces[i];
      const Bsdf bsdf = lit_surface(at);
      for (std::size_t k = 0; k < lights.size(); ++k) {
        const Arriving light = arriving(lights[k], at.position);
        // Neither the shaded nor the true surface is lit from behind.
        const double cosine = dot(at.normal, light.towards);
        if (!(light.strength > 0) || !(cosine > 0) || !(dot(at.flat_normal, light.towards) > 0)) continue;
        const Radiance value = bsdf.evaluate(light.towards);
        if (value == Radiance{}) continue;
        const double seen = light.strength * visibility(k, at, light);
        for (std::size_t c = 0; c < 3; ++c)
          radiance[i][c] +=
              static_cast<float>(seen) * static_cast<float>(cosine * value[c]) * lights[k].intensity[c];
      }
    }
  }

 private:
  double visibility(std::size_t light, const Surface& at, const Arriving& arrives) const {
    if (shadows_ == Shadows::none) return 1;
    if (maps_[light]) return maps_[light]->visibility(at.position, at.flat_normal);
    const double off = scene_.clearance(at.position);
    const double far = arrives.distance - 2 * off;
    Ray ray{to_float(at.position + off * at.flat_normal), to_float(arrives.towards)};
    if (std::isfinite(far)) ray.far = static_cast<float>(std::max(0.0, far));
    return scene_.occluded(ray) ? 0 : 1;
  }

  std::unique_ptr<Shading> under_;
  TracedScene scene_;
  Shadows shadows_;
  std::vector<std::optional<ShadowMap>> maps_;
};

}  // namespace

std::unique_ptr<Shading> with_lights(std::unique_ptr<Shading> shading, const TracedScene& scene,
                                     Shadows shadows, const ShadowMapOptions& options) {
  return std::make_unique<LightShading>(std::move(shading), scene, shadows, options);
}

}  // namespace welkin::scene
