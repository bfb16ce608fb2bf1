#include <algorithm>
#include <cmath>

#include "welkin/brdf/compensation.h"
#include "welkin/brdf/microfacet.h"
#include "welkin/render/shading/anisotropic_look_up.h"
#include "welkin/render/shading/shading_look_ups.h"
#include "welkin/render/shading/sheen.h"
#include "welkin/render/shading/split_sums.h"

namespace welkin::scene {
namespace {

/// Of smoother surfaces the world itself is looked up: the chain's first level has coarser texels.
constexpr float kSharp = 0.02f;

/// `material`: glTF's metallic-roughness, split into a pre-filtered look-up and the integral of the BRDF
/// (Karis 2013), with what scatters several times (Fdez-Agüera 2019), over diffuse light; sheen and clear
/// coat over both; transmission bent once.
class MaterialShading : public Shading {
 public:
  MaterialShading(const Worlds& worlds, const ShadingOptions& options) : worlds_(worlds), options_(options) {
    split_sums();
    if (options.sheen) sheen_sums();
    for_each_world(worlds_, [&](const World& world) {
      world.rough();
      world.diffuse();
      if (options.sheen) world.sheen();
    });
  }

  void shade(std::span<const Surface> surfaces, std::span<Rgb> radiance) const override;

 private:
  struct Layers {
    std::vector<Rgb> specular, diffuse, coat, behind, sheen;
  };
  template <class Rough, class Ray>
  void look_up_lobes(std::span<const Surface> surfaces, const Rough& roughness, const Ray& ray,
                     std::span<Rgb> layer) const;
  Rgb mixed(const Surface& at, const Layers& layers, std::size_t i) const;

  Worlds worlds_;
  ShadingOptions options_;
};

const Sampler& rough_of(const World& world) {
  return world.rough();
}

/// Light that a layer reflects or lets through about `ray`: of its roughness from the chain; of the sharp
/// ones of the world itself, over the pixel's cone.
template <class Rough, class Ray>
void MaterialShading::look_up_lobes(std::span<const Surface> surfaces, const Rough& roughness, const Ray& ray,
                                    std::span<Rgb> layer) const {
  look_up_filtered(worlds_, surfaces,
                   {rough_of, [&](const Surface& at) { return ray(at).direction; },
                    [&](const World& world, const Surface& at) {
                      return world.level_of(widened(roughness(at), at, ray(at)));
                    }},
                   layer);
  std::vector<SurfaceCone> cones;
  for (std::uint32_t i = 0; i < surfaces.size(); ++i)
    if (roughness(surfaces[i]) <= kSharp) cones.push_back({i, ray(surfaces[i]), normal_spread(surfaces[i])});
  std::vector<Rgb> sharp(cones.size());
  look_up_cones(worlds_, surfaces, cones, options_, sharp);
  for (std::size_t k = 0; k < cones.size(); ++k) layer[cones[k].surface] = sharp[k];
}

void MaterialShading::shade(std::span<const Surface> surfaces, std::span<Rgb> radiance) const {
  Layers layers;
  for (auto* layer : {&layers.specular, &layers.diffuse, &layers.coat, &layers.behind, &layers.sheen})
    layer->assign(surfaces.size(), Rgb{});
  const auto any = [&](auto share) { return std::any_of(surfaces.begin(), surfaces.end(), share); };
  const auto rough = [](const Surface& at) { return at.material.roughness; };
  look_up_lobes(surfaces, rough, reflected, layers.specular);
  look_up_filtered(worlds_, surfaces, diffuse_light(), layers.diffuse);
  if (any([](const Surface& at) { return at.material.anisotropy > 0; }))
    look_up_anisotropic(worlds_, surfaces, layers.specular);
  if (any([](const Surface& at) { return is_cloth(at.material); }))
    look_up_filtered(worlds_, surfaces, sheen_light(), layers.sheen);
  if (any([](const Surface& at) { return at.material.clearcoat > 0; }))
    look_up_lobes(
        surfaces, [](const Surface& at) { return at.material.clearcoat_roughness; }, reflected, layers.coat);
  if (any([](const Surface& at) { return at.material.transmission > 0; }))
    look_up_lobes(
        surfaces, rough,
        [](const Surface& at) {
          const double ior = at.material.material->ior;
          return refracted(at, at.from_behind ? 1 / ior : ior);
        },
        layers.behind);
  for (std::size_t i = 0; i < surfaces.size(); ++i) radiance[i] = mixed(surfaces[i], layers, i);
}

Rgb MaterialShading::mixed(const Surface& at, const Layers& layers, std::size_t i) const {
  const MaterialPoint& material = at.material;
  const double nv = std::clamp(dot(at.normal, at.view), 0.0, 1.0);
  const double roughness = material.anisotropy > 0 ? mean_roughness(lobe_facets(at)) : material.roughness;
  const brdf::SplitSum sum = split_sums().at(nv, roughness);
  const double missing = 1 - sum.one;
  const double dielectric = brdf::f0_of_eta<double>(material.material->ior);
  const double f90 = material.metallic + (1 - material.metallic) * grazing_reflectance(dielectric);
  const Sheen sheen(material, nv);
  const double passed_once = sheen.passed(nv), passed_diffuse = sheen.passed_diffuse();
  Rgb result = material.emission;
  for (std::size_t c = 0; c < 3; ++c) {
    const double base = material.base_color[c];
    const double f0 = dielectric + material.metallic * (base - dielectric);
    const double once = sum.reflectance(f0, f90);
    // What is scattered twice and more leaves along all directions, like diffuse light.
    const double often = brdf::fdez_aguera_again(once, brdf::average_fresnel(f0, f90), missing);
    const double under = std::max(0.0, 1 - once - often) * (1 - material.metallic);
    const double passed = under * material.transmission * base;
    const double scattered = under * (1 - material.transmission) * base + often;
    result[c] += static_cast<float>(
        passed_once * once * layers.specular[i][c] + passed_diffuse * scattered * layers.diffuse[i][c] +
        passed_once * passed * layers.behind[i][c] + sheen.albedo()[c] * layers.sheen[i][c]);
  }
  if (material.clearcoat > 0) {
    const double coat = material.clearcoat * brdf::fresnel_schlick(0.04, 1.0, nv);
    result = coat * layers.coat[i] + (1 - coat) * result;
  }
  return result;
}

}  // namespace

std::unique_ptr<Shading> make_material(const Worlds& worlds, const ShadingOptions& options) {
  return std::make_unique<MaterialShading>(worlds, options);
}

}  // namespace welkin::scene
