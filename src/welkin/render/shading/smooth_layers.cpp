#include "welkin/render/shading/smooth_layers.h"

#include <algorithm>
#include <cmath>

#include "welkin/brdf/compensation.h"
#include "welkin/brdf/microfacet.h"
#include "welkin/render/shading/split_sums.h"

namespace welkin::scene {

void prepare_smooth_layers() {
  split_sums();
}

SmoothLayers::SmoothLayers(const Surface& at) {
  const MaterialPoint& point = at.material;
  const Material& material = *point.material;
  const double nv = std::clamp(dot(at.normal, at.view), 0.0, 1.0);
  eta = at.from_behind ? 1.0 / material.ior : material.ior;
  const double coat = point.clearcoat * split_sums().at(nv, point.clearcoat_roughness).reflectance(0.04);
  const double glass = (1 - coat) * (1 - point.metallic) * point.transmission;
  const double opaque = 1 - coat - glass;
  const double metallic = opaque > 0 ? (1 - coat) * point.metallic / opaque : 1;
  const double boundary = brdf::fresnel_dielectric(nv, eta);
  const double dielectric = brdf::f0_of_eta<double>(material.ior);
  const double f90 = metallic + (1 - metallic) * grazing_reflectance(dielectric);
  const brdf::SplitSum sum = split_sums().at(nv, point.roughness);
  const double mean_albedo = split_sums().average(point.roughness).one;
  for (std::size_t c = 0; c < 3; ++c) {
    const double color = std::min<double>(point.base_color[c], 1);
    const double f0 = dielectric + metallic * (color - dielectric);
    const double once = sum.reflectance(f0, f90);
    const double often =
        (1 - sum.one) * brdf::kulla_conty_fresnel(brdf::average_fresnel(f0, f90), mean_albedo);
    const double under = std::max(0.0, 1 - once - often) * (1 - metallic) * color;
    reflected[c] = static_cast<float>(coat + opaque * once + glass * boundary);
    diffuse[c] = static_cast<float>(opaque * (often + under));
    refracted[c] = static_cast<float>(glass * (1 - boundary) * std::sqrt(color));
  }
}

}  // namespace welkin::scene
