#include "welkin/render/shading/shading_look_ups.h"

#include <algorithm>
#include <cmath>

#include "welkin/math/vec_precision.h"
#include "welkin/render/proxy_rays.h"
#include "welkin/render/shading/sheen.h"

namespace welkin::scene {

const World& Worlds::of(std::uint32_t instance) const {
  if (instance >= of_instance.size() || of_instance[instance] < 0) return whole;
  return own.at(static_cast<std::size_t>(of_instance[instance]));
}

void by_world(const Worlds& worlds, std::span<const Surface> surfaces,
              const std::function<void(const World& world, std::span<const std::uint32_t> indices)>& use) {
  std::vector<std::uint32_t> indices(surfaces.size());
  for (std::uint32_t i = 0; i < indices.size(); ++i) indices[i] = i;
  const auto world_of = [&](std::uint32_t i) { return &worlds.of(surfaces[i].instance); };
  if (!worlds.own.empty())
    std::stable_sort(indices.begin(), indices.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return world_of(a) < world_of(b); });
  for (std::size_t first = 0; first < indices.size();) {
    const World* world = world_of(indices[first]);
    std::size_t last = first;
    while (last < indices.size() && world_of(indices[last]) == world) ++last;
    use(*world, std::span(indices).subspan(first, last - first));
    first = last;
  }
}

void to_rgb(std::span<const float> values, int channels, std::span<Rgb> radiance) {
  const auto step = static_cast<std::size_t>(channels);
  for (std::size_t i = 0; i < radiance.size(); ++i) {
    const float* value = values.data() + i * step;
    radiance[i] = channels >= 3 ? Rgb{value[0], value[1], value[2]} : Rgb{value[0], value[0], value[0]};
  }
}

double normal_spread(const Surface& surface) {
  return 2 * std::sqrt(surface.normal_variance);
}

double widened(double roughness, const Surface& at, const RayDifferential& ray) {
  const double pixel = std::sqrt(length(cross(ray.right, ray.down))) / std::sqrt(12.0);
  const double alpha = roughness * roughness;
  const double variance = 2 * at.normal_variance + std::min(pixel * pixel, 1.0) / 2;
  return std::sqrt(std::sqrt(std::min(alpha * alpha + variance, 1.0)));
}

namespace {

EllipticalCone cone_over(const RayDifferential& ray, const ShadingOptions& options) {
  if (options.no_spread) return isotropic_cone(ray.direction, 0);
  // A pixel in which the direction changes by more than this sees about all of the world.
  constexpr double kWidest = 3;
  RayDifferential limited = ray;
  for (Vec3d* side : {&limited.right, &limited.down}) {
    const double size = length(*side);
    if (!std::isfinite(size)) return isotropic_cone(ray.direction, 1);
    if (size > kWidest) *side = (kWidest / size) * *side;
  }
  if (options.quadrilateral) {
    const Vec3d d = normalize(limited.direction);
    const Vec3d right = 0.5 * limited.right, down = 0.5 * limited.down;
    const QuadCone quad{{d - right - down, d + right - down, d + right + down, d - right + down}};
    if (fault_of(quad).empty()) return cone_of(quad);
  }
  return cone_of(limited);
}

}  // namespace

void look_up_cones(const Worlds& worlds, std::span<const Surface> surfaces,
                   std::span<const SurfaceCone> cones, const ShadingOptions& options,
                   std::span<Rgb> radiance) {
  std::vector<EllipticalCone> seen;
  std::vector<std::size_t> places;
  std::vector<float> values;
  std::vector<Rgb> colours;
  for_each_world(worlds, [&](const World& world) {
    seen.clear();
    places.clear();
    for (std::size_t i = 0; i < cones.size(); ++i) {
      const Surface& at = surfaces[cones[i].surface];
      if (&worlds.of(at.instance) != &world) continue;
      const EllipticalCone cone =
          cone_over(seen_from(world.proxy(), {at.position, at.position_change}, cones[i].ray), options);
      seen.push_back(cones[i].sigma > 0 ? blurred(cone, cones[i].sigma) : cone);
      places.push_back(i);
    }
    if (seen.empty()) return;
    const ConeSampler& sampler = world.cones();
    values.resize(seen.size() * static_cast<std::size_t>(sampler.channels()));
    colours.resize(seen.size());
    sampler.look_up(seen, values);
    to_rgb(values, sampler.channels(), colours);
    for (std::size_t k = 0; k < places.size(); ++k) radiance[places[k]] = colours[k];
  });
}

const FilteredLook& diffuse_light() {
  static const FilteredLook look{[](const World& world) -> const Sampler& { return world.diffuse(); },
                                 [](const Surface& at) { return at.normal; }, nullptr};
  return look;
}

const FilteredLook& sheen_light() {
  const auto of = [](const Surface& at) { return Sheen(at.material, dot(at.normal, at.view)).look_up(at); };
  static const FilteredLook look{
      [](const World& world) -> const Sampler& { return world.sheen(); },
      [of](const Surface& at) { return of(at).direction; },
      [of](const World& world, const Surface& at) { return world.sheen_level_of(of(at).roughness); }};
  return look;
}

void look_up_filtered(const Worlds& worlds, std::span<const Surface> surfaces, const FilteredLook& look,
                      std::span<Rgb> radiance) {
  std::vector<Vec3<float>> directions;
  std::vector<float> levels, values;
  std::vector<Rgb> colours;
  by_world(worlds, surfaces, [&](const World& world, std::span<const std::uint32_t> indices) {
    const Sampler& sampler = look.sampler(world);
    directions.clear();
    levels.clear();
    for (const std::uint32_t i : indices) {
      const Surface& at = surfaces[i];
      const Vec3d d = seen_from(world.proxy(), at.position, look.direction(at));
      directions.push_back(to_float(d));
      if (look.level) levels.push_back(static_cast<float>(look.level(world, at)));
    }
    values.resize(indices.size() * static_cast<std::size_t>(sampler.channels()));
    colours.resize(indices.size());
    if (look.level) {
      sampler.look_up(std::span<const Vec3<float>>(directions), values, std::span<const float>(levels));
    } else {
      sampler.look_up(std::span<const Vec3<float>>(directions), values);
    }
    to_rgb(values, sampler.channels(), colours);
    for (std::size_t k = 0; k < indices.size(); ++k) radiance[indices[k]] = colours[k];
  });
}

}  // namespace welkin::scene
