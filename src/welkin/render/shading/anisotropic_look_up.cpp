#include "welkin/render/shading/anisotropic_look_up.h"

#include <algorithm>
#include <cmath>

#include "welkin/math/vec_precision.h"

namespace welkin::scene {
namespace {

/// Narrower lobes are mirrors.
constexpr double kLeastAlpha = 1e-6;
/// Beyond ±u lie 1.3 % of the facets, which the outermost look-ups stand for.
constexpr double kReach = 2.5;
/// From one look-up to the next, in α of their lobes.
constexpr double kGap = 1.5;

}  // namespace

GgxFacets lobe_facets(const Surface& at) {
  return ggx_facets(at.material.roughness, at.material.anisotropy, kLeastAlpha);
}

void append_lobe_taps(const Surface& at, std::vector<LobeTap>& taps) {
  const GgxFacets facets = lobe_facets(at);
  const Grain grain = grain_of(at);
  const Vec3d view = normalize(
      Vec3d{dot(at.view, grain.along), dot(at.view, grain.across), std::max(dot(at.view, at.normal), 1e-4)});
  // Each look-up has a width along the axis too.
  const double spread = std::sqrt(std::max(0.0, facets.x * facets.x - facets.y * facets.y));
  const int count = static_cast<int>(
      std::clamp(std::ceil(2 * kReach * spread / (kGap * facets.y)), 1.0, 1.0 * kMostLobeTaps));
  const double step = 2 * kReach / count, alpha = std::max(facets.y, spread * step / kGap);
  const std::size_t first = taps.size();
  double all = 0;
  for (int k = 0; k < count; ++k) {
    const double u = (k + 0.5) * step - kReach;
    const double before = k == 0 ? -1 : std::tanh(u - step / 2);
    const double after = k == count - 1 ? 1 : std::tanh(u + step / 2);
    const double slope = spread * std::sinh(u), stretch = 1 + slope * slope;
    const Vec3d h{slope / std::sqrt(stretch), 0, 1 / std::sqrt(stretch)};
    const double vh = dot(view, h);
    const Vec3d light = (2 * vh) * h - view;
    if (vh <= 0 || light.z <= 0) continue;
    const double weight = (after - before) / 2 * facets.g2(view, light) * vh / (view.z * h.z);
    // Slopes to angles: by 1/stretch along the axis, by its root across.
    const double width = std::min(1.0, alpha * std::cosh(u) / std::pow(stretch, 0.75));
    all += weight;
    taps.push_back(
        {light.x * grain.along + light.y * grain.across + light.z * at.normal, std::sqrt(width), weight});
  }
  for (std::size_t i = first; i < taps.size(); ++i) taps[i].weight /= all;
  if (taps.size() == first) taps.push_back({reflected(at).direction, mean_roughness(facets), 1});
}

void look_up_anisotropic(const Worlds& worlds, std::span<const Surface> surfaces, std::span<Rgb> radiance) {
  std::vector<LobeTap> taps;
  std::vector<std::uint32_t> owners;
  std::vector<Vec3<float>> directions;
  std::vector<float> levels, values;
  std::vector<Rgb> colours;
  by_world(worlds, surfaces, [&](const World& world, std::span<const std::uint32_t> indices) {
    taps.clear();
    owners.clear();
    directions.clear();
    levels.clear();
    for (const std::uint32_t i : indices) {
      const Surface& at = surfaces[i];
      if (!(at.material.anisotropy > 0)) continue;
      append_lobe_taps(at, taps);
      const RayDifferential mirrored = reflected(at);
      for (std::size_t k = owners.size(); k < taps.size(); ++k) {
        directions.push_back(to_float(seen_from(world.proxy(), at.position, taps[k].direction)));
        levels.push_back(static_cast<float>(world.level_of(widened(taps[k].roughness, at, mirrored))));
      }
      owners.resize(taps.size(), i);
      radiance[i] = {};
    }
    const Sampler& sampler = world.rough();
    values.resize(taps.size() * static_cast<std::size_t>(sampler.channels()));
    colours.resize(taps.size());
    sampler.look_up(std::span<const Vec3<float>>(directions), values, std::span<const float>(levels));
    to_rgb(values, sampler.channels(), colours);
    for (std::size_t k = 0; k < taps.size(); ++k)
      radiance[owners[k]] = radiance[owners[k]] + taps[k].weight * colours[k];
  });
}

}  // namespace welkin::scene
