#include "welkin/render/path/path_light.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "welkin/base/error.h"

namespace welkin::scene {

PathLight::PathLight(const World& world, LightSampling sampling, const Monitor& monitor)
    : world_(world), sampling_(sampling), wanted_(sampling) {
  const bool far = world.proxy().shape == Proxy::Shape::far;
  require(far || sampling != LightSampling::light,
          "light is drawn by the map's brightness only of a world that is infinitely far");
  if (!far) sampling_ = LightSampling::bsdf;
  world.bilinear();
  if (sampling_ == LightSampling::bsdf) return;
  ImportanceOptions options;
  options.compensate = sampling_ == LightSampling::mis;
  options.look_up = Filter::bilinear;
  importance_.emplace(world.map(), options, monitor);
}

Radiance PathLight::seen(const Vec3d& position, const Vec3d& direction) const {
  const Sampler& sampler = world_.bilinear();
  const Vec3d along = seen_from(world_.proxy(), position, direction);
  if (sampler.channels() >= 3) return to_radiance(sampler.rgb(along));
  std::array<float, 2> grey{};
  sampler.look_up(along, std::span(grey).first(static_cast<std::size_t>(sampler.channels())));
  return {grey[0], grey[0], grey[0]};
}

std::optional<DrawnLight> PathLight::draw(const Vec3d& position, PathNumbers& numbers) const {
  const auto [u1, u2] = numbers.pair();
  const ImportanceDraw draw = importance_->draw(u1, u2);
  if (!(draw.pdf > 0)) return std::nullopt;
  return DrawnLight{draw.direction, seen(position, draw.direction), draw.pdf};
}

double PathLight::light_weight(double pdf, double bsdf) const {
  return wanted_ == LightSampling::light ? 1 : pdf / (pdf + bsdf);
}

double PathLight::surface_weight(const Vec3d& direction, double bsdf) const {
  if (sampling_ == LightSampling::bsdf) return 1;
  if (sampling_ == LightSampling::light) return 0;
  return bsdf / (bsdf + importance_->pdf(direction));
}

std::optional<LampLight> lamp_at(const PointLight& lamp, const Vec3d& position) {
  if (lamp.kind == PointLight::Kind::directional)
    return LampLight{-1.0 * lamp.direction, std::numeric_limits<double>::infinity(),
                     to_radiance(lamp.intensity)};
  const Vec3d towards = lamp.position - position;
  const double distance = length(towards);
  if (!(distance > 0)) return std::nullopt;
  LampLight light{(1 / distance) * towards, distance,
                  (1 / (distance * distance)) * to_radiance(lamp.intensity)};
  if (lamp.kind == PointLight::Kind::spot) {
    // Between the cones as glTF's KHR_lights_punctual has it.
    const double cosine = -dot(light.direction, lamp.direction), outer = std::cos(lamp.outer_cone),
                 inner = std::cos(lamp.inner_cone);
    const double part = std::clamp((cosine - outer) / std::max(1e-3, inner - outer), 0.0, 1.0);
    if (part == 0) return std::nullopt;
    light.irradiance = (part * part) * light.irradiance;
  }
  return light;
}

}  // namespace welkin::scene
