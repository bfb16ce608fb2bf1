#include <algorithm>
#include <cmath>

#include "welkin/brdf/compensation.h"
#include "welkin/brdf/microfacet.h"
#include "welkin/render/shading/shading_look_ups.h"
#include "welkin/render/shading/split_sums.h"

namespace welkin::scene {
namespace {

/// The roughness of a surface whose normals and whose reflected directions within a pixel spread besides:
/// slopes' variances add, and α²/2 is GGX's (of its core).
double widened(double roughness, const Surface& at, const RayDifferential& ray) {
  const double pixel = std::sqrt(length(cross(ray.right, ray.down))) / std::sqrt(12.0);
  const double alpha = roughness * roughness;
  const double variance = 2 * at.normal_variance + std::min(pixel * pixel, 1.0) / 2;
  return std::sqrt(std::sqrt(std::min(alpha * alpha + variance, 1.0)));
}

/// `material`: glTF's metallic-roughness, split into a pre-filtered look-up and the integral of the BRDF
/// (Karis 2013), with what scatters several times (Fdez-Agüera 2019), over diffuse light; clear coat;
/// transmission bent once.
class MaterialShading : public Shading {
 public:
  MaterialShading(const Worlds& worlds, const ShadingOptions& options) : worlds_(worlds), options_(options) {
    split_sums();
    for_each_world(worlds_, [](const World& world) {
      world.rough();
      world.diffuse();
    });
  }

  void shade(std::span<const Surface> surfaces, std::span<Rgb> radiance) const override;

 private:
  struct Layers {
    std::vector<Rgb> specular, diffuse, coat, behind;
  };
  Rgb mixed(const Surface& at, const Layers& layers, std::size_t i) const;

  Worlds worlds_;
  ShadingOptions options_;
};

const Sampler& rough_of(const World& world) {
  return world.rough();
}

void MaterialShading::shade(std::span<const Surface> surfaces, std::span<Rgb> radiance) const {
  Layers layers;
  for (auto* layer : {&layers.specular, &layers.diffuse, &layers.coat, &layers.behind})
    layer->assign(surfaces.size(), Rgb{});
  look_up_filtered(worlds_, surfaces,
                   {rough_of, [](const Surface& at) { return reflected(at).direction; },
                    [](const World& world, const Surface& at) {
                      return world.level_of(widened(at.material.roughness, at, reflected(at)));
                    }},
                   layers.specular);
  look_up_filtered(worlds_, surfaces, diffuse_light(), layers.diffuse);
  const auto any = [&](auto share) { return std::any_of(surfaces.begin(), surfaces.end(), share); };
  if (any([](const Surface& at) { return at.material.clearcoat > 0; }))
    look_up_filtered(
        worlds_, surfaces,
        {rough_of, [](const Surface& at) { return reflected(at).direction; },
         [](const World& world, const Surface& at) {
           return world.level_of(widened(at.material.material->clearcoat_roughness, at, reflected(at)));
         }},
        layers.coat);
  if (any([](const Surface& at) { return at.material.transmission > 0; })) {
    const auto bent = [](const Surface& at) {
      const double ior = at.material.material->ior;
      return refracted(at, at.from_behind ? 1 / ior : ior);
    };
    look_up_filtered(worlds_, surfaces,
                     {rough_of, [bent](const Surface& at) { return bent(at).direction; },
                      [bent](const World& world, const Surface& at) {
                        return world.level_of(widened(at.material.roughness, at, bent(at)));
                      }},
                     layers.behind);
  }
  for (std::size_t i = 0; i < surfaces.size(); ++i) radiance[i] = mixed(surfaces[i], layers, i);
}

Rgb MaterialShading::mixed(const Surface& at, const Layers& layers, std::size_t i) const {
  const MaterialPoint& material = at.material;
  const double nv = std::clamp(dot(at.normal, at.view), 0.0, 1.0);
  const brdf::SplitSum sum = split_sums().at(nv, material.roughness);
  const double missing = 1 - sum.one;
  const double dielectric = brdf::f0_of_eta<double>(material.material->ior);
  const double f90 = material.metallic + (1 - material.metallic) * grazing_reflectance(dielectric);
  Rgb result = material.emission;
  for (std::size_t c = 0; c < 3; ++c) {
    const double base = material.base_color[c];
    const double f0 = dielectric + material.metallic * (base - dielectric);
    const double once = sum.reflectance(f0, f90);
    // What is scattered twice and more leaves along all directions, like diffuse light.
    const double mean = brdf::average_fresnel(f0, f90), often = once * mean * missing / (1 - mean * missing);
    const double under = std::max(0.0, 1 - once - often) * (1 - material.metallic);
    const double passed = under * material.transmission * base;
    const double scattered = under * (1 - material.transmission) * base + often;
    result[c] += static_cast<float>(once * layers.specular[i][c] + scattered * layers.diffuse[i][c] +
                                    passed * layers.behind[i][c]);
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
