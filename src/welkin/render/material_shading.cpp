#include <algorithm>
#include <cmath>

#include "welkin/brdf/dfg_table.h"
#include "welkin/brdf/microfacet.h"
#include "welkin/render/shading_look_ups.h"

namespace welkin::scene {
namespace {

/// GGX's scale and bias over n·v and roughness.
class SplitSums {
 public:
  SplitSums() {
    brdf::DfgTable table;
    table.width = table.height = kSide;
    table.cosine = brdf::CosineScale::root;
    table.placement = brdf::TexelPlacement::ends;
    image_ = brdf::make_dfg_table(table);
  }

  std::array<double, 2> at(double nv, double roughness) const {
    const double x = std::sqrt(std::clamp(nv, 0.0, 1.0)) * (kSide - 1),
                 y = std::clamp(roughness, 0.0, 1.0) * (kSide - 1);
    const int i = std::min(static_cast<int>(x), kSide - 2), j = std::min(static_cast<int>(y), kSide - 2);
    const double fx = x - i, fy = y - j;
    std::array<double, 2> value{};
    for (int c = 0; c < 2; ++c)
      value[static_cast<std::size_t>(c)] =
          (1 - fy) * ((1 - fx) * image_.at(i, j)[c] + fx * image_.at(i + 1, j)[c]) +
          fy * ((1 - fx) * image_.at(i, j + 1)[c] + fx * image_.at(i + 1, j + 1)[c]);
    return value;
  }

 private:
  static constexpr int kSide = 128;
  Image image_;
};

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
    const auto prepare = [](const World& world) {
      world.rough();
      world.diffuse();
    };
    prepare(worlds_.whole);
    for (const World& world : worlds_.own) prepare(world);
  }

  void shade(std::span<const Surface> surfaces, std::span<Rgb> radiance) const override;

 private:
  struct Layers {
    std::vector<Rgb> specular, diffuse, coat, behind;
  };
  Rgb mixed(const Surface& at, const Layers& layers, std::size_t i) const;

  Worlds worlds_;
  ShadingOptions options_;
  SplitSums sums_;
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
  look_up_filtered(worlds_, surfaces,
                   {[](const World& world) -> const Sampler& { return world.diffuse(); },
                    [](const Surface& at) { return at.normal; }, nullptr},
                   layers.diffuse);
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
  const auto [scale, bias] = sums_.at(nv, material.roughness);
  const double albedo = scale + bias, missing = 1 - albedo;
  const double dielectric = brdf::f0_of_eta<double>(material.material->ior);
  Rgb result = material.emission;
  for (std::size_t c = 0; c < 3; ++c) {
    const double base = material.base_color[c];
    const double f0 = dielectric + material.metallic * (base - dielectric);
    const double once = f0 * scale + bias;
    // What is scattered twice and more leaves along all directions, like diffuse light.
    const double mean = f0 + (1 - f0) / 21, often = once * mean * missing / (1 - mean * missing);
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
