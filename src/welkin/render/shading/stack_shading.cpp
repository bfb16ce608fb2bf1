#include <algorithm>
#include <map>
#include <optional>

#include "welkin/brdf/compensation.h"
#include "welkin/prefilter/view_bake.h"
#include "welkin/prefilter/view_stack.h"
#include "welkin/render/shading/shading_look_ups.h"
#include "welkin/render/shading/split_sums.h"
#include "welkin/render/shading/view_maps.h"

namespace welkin::scene {
namespace {

double cosine_of(const Vec3d& normal, const Vec3d& view) {
  return std::clamp(dot(normal, view), 0.0, 1.0);
}

/// The mean radiance in a stack's lobe. `values` is room to work in.
Rgb lobe_mean(const ViewStack& stack, const Vec3d& normal, const Vec3d& view, double level,
              std::vector<float>& values) {
  values.resize(static_cast<std::size_t>(stack.channels()));
  stack.look_up(normal, view, values, level);
  Rgb seen{};
  to_rgb(values, stack.channels(), {&seen, 1});
  return seen;
}

/// GGX's share of even light by integrals, which a stack has for a few roughnesses alone, and what its facets
/// scatter more than once (Fdez-Agüera 2019), which the BRDF leaves out.
class GgxAlbedo {
 public:
  /// Of no other BRDF.
  static std::optional<GgxAlbedo> of(const brdf::AnyBrdf& brdf, const Worlds& worlds) {
    if (brdf.name() != "ggx") return std::nullopt;
    double f0 = 1;
    for (const Parameter& parameter : brdf.parameters())
      if (parameter.name == "f0") f0 = parameter.value;
    split_sums();
    for_each_world(worlds, [](const World& world) { world.diffuse(); });
    return GgxAlbedo(worlds, f0);
  }

  /// Of white surfaces, scattered once.
  double once(double view_cosine, double roughness) const {
    return split_sums().at(view_cosine, roughness).reflectance(f0_, 1);
  }

  /// Adds what is scattered again to what surfaces of these roughnesses send.
  template <class Roughness>
  void add_again(std::span<const Surface> surfaces, const Roughness& roughness,
                 std::span<Rgb> radiance) const {
    std::vector<Rgb> diffuse(surfaces.size());
    look_up_filtered(worlds_, surfaces, diffuse_light(), diffuse);
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
      const Surface& at = surfaces[i];
      const brdf::SplitSum sum = split_sums().at(dot(at.normal, at.view), roughness(at));
      for (std::size_t c = 0; c < 3; ++c) {
        const double base = at.material.base_color[c], once = base * sum.reflectance(f0_, 1);
        const double again = brdf::fdez_aguera_again(once, base * brdf::average_fresnel(f0_), 1 - sum.one);
        radiance[i][c] += static_cast<float>(again * diffuse[i][c]);
      }
    }
  }

 private:
  GgxAlbedo(const Worlds& worlds, double f0) : worlds_(worlds), f0_(f0) {}

  Worlds worlds_;
  double f0_;
};

/// `stack`: the world pre-filtered with a BRDF's lobe as it is seen from several angles (Kautz & McCool
/// 2000), looked up with n·v; of the base colour, without Fresnel's factor unless the BRDF has its own. GGX
/// keeps its light.
class StackShading : public Shading {
 public:
  StackShading(const Worlds& worlds, const ShadingOptions& options) : worlds_(worlds) {
    ViewBakeOptions bake;
    bake.brdf = brdf::AnyBrdf::make(options.brdf);
    rough_ = bake.brdf.has_roughness();
    ggx_ = GgxAlbedo::of(bake.brdf, worlds_);
    // Each level has half the side of the one before: few, so that the widest lobes keep some texels.
    bake.bake.size = ChartSize{192, 192};
    if (rough_) bake.bake.curve = lobe::RoughnessCurve::from_name("0,0.1,0.2,0.35,0.6,1");
    for_each_world(worlds_, [&](const World& world) {
      stacks_.emplace(&world.map(), ViewStack(bake_views(world.map(), bake)));
    });
  }

  void shade(std::span<const Surface> surfaces, std::span<Rgb> radiance) const override {
    std::vector<float> values;
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
      const Surface& at = surfaces[i];
      const ViewStack& stack = stacks_.at(&worlds_.of(at.instance).map());
      const double roughness = std::clamp<double>(at.material.roughness, 0, 1);
      const double level = rough_ ? stack.level_of(roughness) : 0, cosine = cosine_of(at.normal, at.view);
      const double albedo = ggx_ ? ggx_->once(cosine, roughness) : stack.albedo(cosine, level);
      const Rgb mean = lobe_mean(stack, at.normal, at.view, level, values);
      radiance[i] = at.material.base_color * (albedo * mean);
    }
    if (ggx_) {
      ggx_->add_again(
          surfaces, [](const Surface& at) { return at.material.roughness; }, radiance);
    }
  }

 private:
  Worlds worlds_;
  bool rough_ = false;
  std::optional<GgxAlbedo> ggx_;
  std::map<const Map*, ViewStack> stacks_;
};

/// `warped`: the same, baked into pictures of a ball from a few directions, of which the nearest are warped.
class WarpedShading : public Shading {
 public:
  WarpedShading(const Worlds& worlds, const ShadingOptions& options) : worlds_(worlds) {
    if (!options.view_maps.empty()) {
      views_.emplace(nullptr, copies(options.view_maps));
      return;
    }
    ViewBakeOptions bake;
    bake.brdf = brdf::AnyBrdf::make(options.brdf);
    if (bake.brdf.has_roughness()) roughness_ = bake.brdf.roughness();
    ggx_ = GgxAlbedo::of(bake.brdf, worlds_);
    bake.bake.chain = false;
    bake.bake.size = ChartSize{128, 128};
    for_each_world(worlds_, [&](const World& world) {
      const ViewStack stack(bake_views(world.map(), bake));
      views_.emplace(
          &world.map(),
          view_maps(even_directions(options.views), kMapSize, [&](const Vec3d& normal, const Vec3d& view) {
            std::vector<float> values;
            return stack.albedo(cosine_of(normal, view)) * lobe_mean(stack, normal, view, 0, values);
          }));
    });
  }

  void shade(std::span<const Surface> surfaces, std::span<Rgb> radiance) const override {
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
      const Surface& at = surfaces[i];
      const auto own = views_.find(nullptr);
      const WarpedViews& views =
          own != views_.end() ? own->second : views_.at(&worlds_.of(at.instance).map());
      radiance[i] = at.material.base_color * views.rgb(at.normal, at.view);
    }
    if (ggx_) {
      ggx_->add_again(
          surfaces, [this](const Surface&) { return roughness_; }, radiance);
    }
  }

 private:
  static constexpr int kMapSize = 256;

  static std::vector<ViewMap> copies(std::span<const std::shared_ptr<const ViewMap>> maps) {
    std::vector<ViewMap> all;
    for (const auto& map : maps) {
      const Image& from = map->picture;
      all.push_back({map->to_eye, Image(from.width(), from.height(), from.channels())});
      copy_pixels(from.view(), all.back().picture.view());
    }
    return all;
  }

  Worlds worlds_;
  double roughness_ = 0;
  std::optional<GgxAlbedo> ggx_;             // not of photographs
  std::map<const Map*, WarpedViews> views_;  // of no map: those that were given
};

}  // namespace

std::unique_ptr<Shading> make_warped(const Worlds& worlds, const ShadingOptions& options) {
  return std::make_unique<WarpedShading>(worlds, options);
}

std::unique_ptr<Shading> make_stack(const Worlds& worlds, const ShadingOptions& options) {
  return std::make_unique<StackShading>(worlds, options);
}

}  // namespace welkin::scene
