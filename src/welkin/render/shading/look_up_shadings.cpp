#include <algorithm>
#include <array>
#include <cmath>

#include "welkin/brdf/microfacet.h"
#include "welkin/lobe/lobe.h"
#include "welkin/render/shading/shading_look_ups.h"

namespace welkin::scene {
namespace {

double cosine_of(const Surface& at) {
  return std::clamp(dot(at.normal, at.view), 0.0, 1.0);
}

/// Times the base colour.
void tint(std::span<const Surface> surfaces, std::span<Rgb> radiance) {
  for (std::size_t i = 0; i < surfaces.size(); ++i)
    radiance[i] = surfaces[i].material.base_color * radiance[i];
}

/// Reflected light as the options combine it with what lies under it: alone, of the base colour, or with
/// Fresnel's factor and diffuse light.
void over_diffuse(const Worlds& worlds, const ShadingOptions& options, std::span<const Surface> surfaces,
                  std::span<Rgb> radiance) {
  if (options.fresnel == Fresnel::none) return tint(surfaces, radiance);
  std::vector<Rgb> diffuse(surfaces.size());
  look_up_filtered(worlds, surfaces, diffuse_light(), diffuse);
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const double f = brdf::fresnel_dielectric(cosine_of(surfaces[i]), options.eta);
    const double rest = options.fresnel == Fresnel::share ? 1 - f : 1;
    radiance[i] = f * radiance[i] + rest * (surfaces[i].material.base_color * diffuse[i]);
  }
}

/// `mirror`: the world over the pixel's reflected cone; Fresnel's part of it over diffuse light.
class Mirror : public Shading {
 public:
  Mirror(const Worlds& worlds, const ShadingOptions& options) : worlds_(worlds), options_(options) {
    for_each_world(worlds_, [&](const World& world) {
      world.cones();
      if (options.fresnel != Fresnel::none) world.diffuse();
    });
  }

  void shade(std::span<const Surface> surfaces, std::span<Rgb> radiance) const override {
    std::vector<SurfaceCone> cones;
    for (std::uint32_t i = 0; i < surfaces.size(); ++i)
      cones.push_back({i, reflected(surfaces[i]), normal_spread(surfaces[i])});
    look_up_cones(worlds_, surfaces, cones, options_, radiance);
    over_diffuse(worlds_, options_, surfaces, radiance);
  }

 private:
  Worlds worlds_;
  ShadingOptions options_;
};

/// `glossy`: the world over the pixel's reflected cone, widened by the lobe of the material's roughness, with
/// no pre-filtered chain: whatever the filter makes of it.
class Glossy : public Shading {
 public:
  Glossy(const Worlds& worlds, const ShadingOptions& options) : worlds_(worlds), options_(options) {
    for_each_world(worlds_, [](const World& world) { world.cones(); });
    const lobe::AnyLobe ggx = lobe::AnyLobe::make("ggx");
    for (std::size_t i = 1; i < sigma_.size(); ++i)
      sigma_[i] = lobe_sigma_of(ggx.with_roughness(static_cast<double>(i) / (kSteps - 1)));
  }

  void shade(std::span<const Surface> surfaces, std::span<Rgb> radiance) const override {
    std::vector<SurfaceCone> cones;
    for (std::uint32_t i = 0; i < surfaces.size(); ++i) {
      const double bumps = normal_spread(surfaces[i]), lobe = sigma_of(surfaces[i].material.roughness);
      cones.push_back({i, reflected(surfaces[i]), std::sqrt(bumps * bumps + lobe * lobe)});
    }
    look_up_cones(worlds_, surfaces, cones, options_, radiance);
    tint(surfaces, radiance);
  }

 private:
  static constexpr int kSteps = 65;

  double sigma_of(double roughness) const {
    const double x = std::clamp(roughness, 0.0, 1.0) * (kSteps - 1);
    const auto i = std::min(static_cast<std::size_t>(x), static_cast<std::size_t>(kSteps - 2));
    return sigma_[i] + (x - static_cast<double>(i)) * (sigma_[i + 1] - sigma_[i]);
  }

  Worlds worlds_;
  ShadingOptions options_;
  std::array<double, kSteps> sigma_{};  // by roughness
};

/// `refraction`: F of the reflected cone, the rest of the one bent once.
class Refraction : public Shading {
 public:
  Refraction(const Worlds& worlds, const ShadingOptions& options) : worlds_(worlds), options_(options) {
    for_each_world(worlds_, [](const World& world) { world.cones(); });
  }

  void shade(std::span<const Surface> surfaces, std::span<Rgb> radiance) const override {
    std::vector<SurfaceCone> cones;
    const auto count = static_cast<std::uint32_t>(surfaces.size());
    for (std::uint32_t i = 0; i < count; ++i)
      cones.push_back({i, reflected(surfaces[i]), normal_spread(surfaces[i])});
    for (std::uint32_t i = 0; i < count; ++i)
      cones.push_back({i, refracted(surfaces[i], eta_of(surfaces[i])), 0});
    std::vector<Rgb> both(cones.size());
    look_up_cones(worlds_, surfaces, cones, options_, both);
    for (std::size_t i = 0; i < count; ++i) {
      const double f = brdf::fresnel_dielectric(cosine_of(surfaces[i]), eta_of(surfaces[i]));
      radiance[i] = f * both[i] + (1 - f) * (surfaces[i].material.base_color * both[count + i]);
    }
  }

 private:
  double eta_of(const Surface& at) const { return at.from_behind ? 1 / options_.eta : options_.eta; }

  Worlds worlds_;
  ShadingOptions options_;
};

/// `diffuse`.
class Diffuse : public Shading {
 public:
  Diffuse(const Worlds& worlds, const ShadingOptions&) : worlds_(worlds) {
    for_each_world(worlds_, [](const World& world) { world.diffuse(); });
  }

  void shade(std::span<const Surface> surfaces, std::span<Rgb> radiance) const override {
    look_up_filtered(worlds_, surfaces, diffuse_light(), radiance);
    tint(surfaces, radiance);
  }

 private:
  Worlds worlds_;
};

/// `globe`: dc·D + sc·S without an ambient term, sc the material's metallic and dc what is left.
class Globe : public Shading {
 public:
  Globe(const Worlds& worlds, const ShadingOptions& options)
      : diffuse_(worlds, options), mirror_(worlds, plain(options)) {}

  void shade(std::span<const Surface> surfaces, std::span<Rgb> radiance) const override {
    std::vector<Rgb> specular(surfaces.size());
    diffuse_.shade(surfaces, radiance);
    mirror_.shade(surfaces, specular);
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
      const double sc = surfaces[i].material.metallic;
      radiance[i] = (1 - sc) * radiance[i] + sc * specular[i];
    }
  }

 private:
  static ShadingOptions plain(ShadingOptions options) {
    options.fresnel = Fresnel::none;
    return options;
  }

  Diffuse diffuse_;
  Mirror mirror_;
};

/// `phong`: the light in Phong's lobe, and diffuse light as for a mirror.
class Phong : public Shading {
 public:
  Phong(const Worlds& worlds, const ShadingOptions& options) : worlds_(worlds), options_(options) {
    for_each_world(worlds_, [&](const World& world) {
      world.phong(options.exponent);
      if (options.fresnel != Fresnel::none) world.diffuse();
    });
  }

  void shade(std::span<const Surface> surfaces, std::span<Rgb> radiance) const override {
    const double exponent = options_.exponent;
    look_up_filtered(worlds_, surfaces,
                     {[exponent](const World& world) -> const Sampler& { return world.phong(exponent); },
                      [](const Surface& at) { return reflected(at).direction; }, nullptr},
                     radiance);
    over_diffuse(worlds_, options_, surfaces, radiance);
  }

 private:
  Worlds worlds_;
  ShadingOptions options_;
};

/// `normals`.
class Normals : public Shading {
 public:
  void shade(std::span<const Surface> surfaces, std::span<Rgb> radiance) const override {
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
      const Vec3d& n = surfaces[i].normal;
      const auto half = [](double c) { return static_cast<float>((c + 1) / 2); };
      radiance[i] = {half(n.x), half(n.y), half(n.z)};
    }
  }
};

}  // namespace

std::unique_ptr<Shading> make_mirror(const Worlds& worlds, const ShadingOptions& options) {
  return std::make_unique<Mirror>(worlds, options);
}
std::unique_ptr<Shading> make_glossy(const Worlds& worlds, const ShadingOptions& options) {
  return std::make_unique<Glossy>(worlds, options);
}
std::unique_ptr<Shading> make_refraction(const Worlds& worlds, const ShadingOptions& options) {
  return std::make_unique<Refraction>(worlds, options);
}
std::unique_ptr<Shading> make_diffuse(const Worlds& worlds, const ShadingOptions& options) {
  return std::make_unique<Diffuse>(worlds, options);
}
std::unique_ptr<Shading> make_globe(const Worlds& worlds, const ShadingOptions& options) {
  return std::make_unique<Globe>(worlds, options);
}
std::unique_ptr<Shading> make_phong(const Worlds& worlds, const ShadingOptions& options) {
  return std::make_unique<Phong>(worlds, options);
}
std::unique_ptr<Shading> make_normals(const Worlds&, const ShadingOptions&) {
  return std::make_unique<Normals>();
}

}  // namespace welkin::scene
