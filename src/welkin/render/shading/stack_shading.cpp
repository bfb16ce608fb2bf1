#include <algorithm>
#include <map>
#include <optional>

#include "welkin/brdf/microfacet.h"
#include "welkin/prefilter/view_bake.h"
#include "welkin/prefilter/view_stack.h"
#include "welkin/render/shading/shading_look_ups.h"
#include "welkin/render/shading/view_maps.h"

namespace welkin::scene {
namespace {

/// What a stack's surface sends to the viewer, white. `values` is room to work in.
Rgb sent(const ViewStack& stack, const Vec3d& normal, const Vec3d& view, double level,
         std::vector<float>& values) {
  values.resize(static_cast<std::size_t>(stack.channels()));
  stack.look_up(normal, view, values, level);
  Rgb seen{};
  to_rgb(values, stack.channels(), {&seen, 1});
  return stack.albedo(std::clamp(dot(normal, view), 0.0, 1.0), level) * seen;
}

/// `stack`: the world pre-filtered with a BRDF's lobe as it is seen from several angles (Kautz & McCool
/// 2000), looked up with n·v; of the base colour, without Fresnel's factor unless the BRDF has its own.
class StackShading : public Shading {
 public:
  StackShading(const Worlds& worlds, const ShadingOptions& options) : worlds_(worlds) {
    ViewBakeOptions bake;
    bake.brdf = brdf::AnyBrdf::make(options.brdf);
    rough_ = bake.brdf.has_roughness();
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
      const double level = rough_ ? stack.level_of(std::clamp<double>(at.material.roughness, 0, 1)) : 0;
      radiance[i] = at.material.base_color * sent(stack, at.normal, at.view, level, values);
    }
  }

 private:
  Worlds worlds_;
  bool rough_ = false;
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
    bake.bake.chain = false;
    bake.bake.size = ChartSize{128, 128};
    for_each_world(worlds_, [&](const World& world) {
      const ViewStack stack(bake_views(world.map(), bake));
      views_.emplace(&world.map(), view_maps(even_directions(options.views), kMapSize,
                                             [&](const Vec3d& normal, const Vec3d& view) {
                                               std::vector<float> values;
                                               return sent(stack, normal, view, 0, values);
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
