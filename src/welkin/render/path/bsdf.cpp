#include "welkin/render/path/bsdf.h"

#include <cmath>

#include "welkin/brdf/compensation.h"
#include "welkin/brdf/microfacet.h"
#include "welkin/render/path/glass_energy.h"
#include "welkin/render/path/hemisphere_draws.h"
#include "welkin/render/path/refraction.h"
#include "welkin/render/shading/split_sums.h"

namespace welkin::scene {
namespace {

constexpr double kCoatF0 = 0.04;

double squared(double x) {
  return x * x;
}

/// The facet that sends light to the viewer, reflected or bent, and the cosines of both to it.
struct GlassFacet {
  Vec3d h;
  double vh, lh;
};
/// None where light comes from the facet's other side.
std::optional<GlassFacet> glass_facet(const Vec3d& view, const Vec3d& light, double eta) {
  const bool above = light.z > 0;
  Vec3d h = normalize(above ? view + light : view + eta * light);
  if (h.z < 0) h = -1.0 * h;
  const double vh = dot(view, h), lh = dot(light, h);
  if (vh <= 0 || (lh > 0) != above) return std::nullopt;
  return GlassFacet{h, vh, lh};
}

GgxFacets facets_of(double roughness, double anisotropy) {
  return ggx_facets(roughness, anisotropy, squared(Bsdf::kMirrorRoughness));
}

}  // namespace

Bsdf::Bsdf(const Surface& at) : normal_(at.normal), flat_(at.flat_normal) {
  const MaterialPoint& point = at.material;
  const Material& material = *point.material;
  const Grain grain = grain_of(at);
  tangent_ = grain.along;
  bitangent_ = grain.across;
  view_ = to_local(at.view);
  view_.z = std::max(view_.z, kLeastCosine);
  view_ = normalize(view_);

  facets_ = facets_of(point.roughness, point.anisotropy);
  coat_facets_ = facets_of(point.clearcoat_roughness, 0);
  roughness_ = mean_roughness(facets_);
  coat_roughness_ = point.clearcoat_roughness;
  sheen_ = Sheen(point, view_.z);
  coat_ = point.clearcoat;
  eta_ = at.from_behind ? 1.0 / material.ior : material.ior;
  glass_ = (1.0 - point.metallic) * point.transmission;
  if (glass_ > 0 && !is_mirror(glass)) set_glass_losses(material.ior, at.from_behind);
  opaque_ = 1 - glass_;
  // The opaque share is of metal, and of what dielectric isn't glass.
  const double metallic = opaque_ > 0 ? point.metallic / opaque_ : 1;
  const double dielectric = brdf::f0_of_eta<double>(material.ior);
  f90_ = metallic + (1 - metallic) * grazing_reflectance(dielectric);
  const brdf::SplitSum sum = split_sums().at(view_.z, roughness_), whole = split_sums().average(roughness_);
  lost_view_ = std::max(0.0, 1 - sum.one);
  mean_lost_ = std::max(0.0, 1 - whole.one);
  for (std::size_t i = 0; i < 3; ++i) {
    const double color = std::min<double>(point.base_color[i], 1);
    tint_[i] = std::sqrt(color);
    f0_[i] = dielectric + metallic * (color - dielectric);
    base_[i] = (1 - metallic) * color;
    often_[i] = brdf::kulla_conty_fresnel(brdf::average_fresnel(f0_[i], f90_), whole.one);
    mean_under_[i] = std::max(1e-6, 1 - whole.reflectance(f0_[i], f90_) - mean_lost_ * often_[i]);
  }
  coat_albedo_ = coat_ > 0 ? coat_ * split_sums().at(view_.z, coat_roughness_).reflectance(kCoatF0) : 0;

  const Radiance reflected = reflectance(view_.z);
  const double once = sum.reflectance(mean(f0_), f90_);
  probability_[coat] = coat_albedo_;
  probability_[specular] = opaque_ * (1 - coat_albedo_) * once;
  double under = 0;
  for (std::size_t i = 0; i < 3; ++i) under += base_[i] * std::max(0.0, 1 - reflected[i]) / 3;
  probability_[diffuse] = opaque_ * (1 - coat_albedo_) * under;
  probability_[multiple] = opaque_ * (1 - coat_albedo_) * lost_view_ * mean(often_);
  probability_[glass] = glass_ * (1 - coat_albedo_) * (1 - lost_in_glass_);
  probability_[glass_again] = glass_ * (1 - coat_albedo_) * lost_in_glass_;
  double all = 0;
  for (const double p : probability_) all += p;
  for (double& p : probability_) p = all > 0 ? p / all : 0;
  if (sheen_) share_with_sheen(all);
}

void Bsdf::share_with_sheen(double others) {
  const double shine = (1 - coat_albedo_) * mean(sheen_.albedo());
  const double under = coat_albedo_ + std::max(0.0, others - coat_albedo_) * sheen_.passed(view_.z);
  for (double& p : probability_) p *= under / (shine + under);
  probability_[cloth] = shine / (shine + under);
}

void Bsdf::set_glass_losses(double ior, bool from_behind) {
  const GlassEnergy& energy = glass_energy(ior);
  before_ = &energy.before(from_behind);
  behind_ = &energy.behind(from_behind);
  lost_in_glass_ = before_->at(view_.z, roughness_);
  again_through_ = energy.through(from_behind, roughness_);
}

double Bsdf::again(double cosine) const {
  const bool above = cosine > 0;
  const GlassLoss& side = above ? *before_ : *behind_;
  const double mean = side.average(roughness_), share = above ? 1 - again_through_ : again_through_;
  return mean > 0 ? share * side.at(std::abs(cosine), roughness_) / (kPi * mean) : 0;
}

Radiance Bsdf::reflectance(double cosine) const {
  const brdf::SplitSum sum = split_sums().at(cosine, roughness_);
  Radiance value;
  for (std::size_t i = 0; i < 3; ++i)
    value[i] = sum.reflectance(f0_[i], f90_) + std::max(0.0, 1 - sum.one) * often_[i];
  return value;
}

Vec3d Bsdf::to_local(const Vec3d& d) const {
  return {dot(d, tangent_), dot(d, bitangent_), dot(d, normal_)};
}

Vec3d Bsdf::to_world(const Vec3d& d) const {
  return normalize(d.x * tangent_ + d.y * bitangent_ + d.z * normal_);
}

bool Bsdf::is_mirror(Lobe lobe) const {
  switch (lobe) {
    case coat:
      return coat_roughness_ < kMirrorRoughness;
    case specular:
      return facets_.x <= squared(kMirrorRoughness);
    case glass:
      return facets_.x <= squared(kMirrorRoughness) || eta_ == 1;
    default:
      return false;
  }
}

bool Bsdf::scatters() const {
  for (const Lobe lobe : kAll)
    if (probability_[lobe] > 0 && !is_mirror(lobe)) return true;
  return false;
}

bool Bsdf::on_one_side(const Vec3d& world, const Vec3d& local) const {
  return local.z * dot(world, flat_) > 0;
}

double Bsdf::below_coat(double cosine) const {
  return through_coat(cosine) * sheen_.passed(std::abs(cosine));
}

double Bsdf::through_coat(double cosine) const {
  if (coat_ == 0) return 1;
  const double other =
      coat_ * split_sums().at(std::max(std::abs(cosine), kLeastCosine), coat_roughness_).reflectance(kCoatF0);
  return 1 - std::max(coat_albedo_, other);
}

Radiance Bsdf::value(Lobe lobe, const Vec3d& light) const {
  const bool above = light.z > 0;
  if (!above && lobe != glass && lobe != glass_again) return {};
  switch (lobe) {
    case coat:
    case specular: {
      const GgxFacets& facets = lobe == coat ? coat_facets_ : facets_;
      const Vec3d h = normalize(view_ + light);
      const double scale = facets.distribution(h) * facets.g2(view_, light) / (4 * view_.z * light.z);
      const double f = brdf::schlick_weight(std::clamp(dot(view_, h), 0.0, 1.0));
      if (lobe == coat) {
        const double value = coat_ * scale * (kCoatF0 + (1 - kCoatF0) * f);
        return {value, value, value};
      }
      Radiance value;
      for (std::size_t i = 0; i < 3; ++i)
        value[i] = opaque_ * below_coat(light.z) * scale * (f0_[i] + (f90_ - f0_[i]) * f);
      return value;
    }
    case diffuse: {
      const Radiance from = reflectance(view_.z), to = reflectance(light.z);
      Radiance value;
      for (std::size_t i = 0; i < 3; ++i) {
        const double under =
            base_[i] * std::max(0.0, 1 - from[i]) * std::max(0.0, 1 - to[i]) / mean_under_[i];
        value[i] = opaque_ * below_coat(light.z) * under / kPi;
      }
      return value;
    }
    case cloth:
      return through_coat(light.z) * sheen_.value(view_, light);
    case multiple: {
      const double lost = std::max(0.0, 1 - split_sums().at(light.z, roughness_).one);
      const double often = mean_lost_ > 0 ? lost_view_ * lost / (kPi * mean_lost_) : 0;
      return (opaque_ * below_coat(light.z) * often) * often_;
    }
    case glass: {
      const auto facet = glass_facet(view_, light, eta_);
      if (!facet) return {};
      const auto& [h, vh, lh] = *facet;
      const double f = brdf::fresnel_dielectric(std::min(vh, 1.0), eta_), d = facets_.distribution(h);
      const double weight = glass_ * below_coat(light.z);
      if (above) {
        const double value = weight * f * d * facets_.g2(view_, light) / (4 * view_.z * light.z);
        return {value, value, value};
      }
      // Walter et al. 2007, eq. 21.
      const double masked = facets_.g1(view_) * facets_.g1(light);
      const double jacobian = vh * -lh / squared(vh + eta_ * lh);
      return (weight * (1 - f) * d * masked * jacobian / (view_.z * -light.z)) * tint_;
    }
    case glass_again: {
      const double value = glass_ * below_coat(light.z) * lost_in_glass_ * again(light.z);
      if (above) return {value, value, value};
      return (value / squared(eta_)) * tint_;
    }
    default:
      return {};
  }
}

double Bsdf::density(Lobe lobe, const Vec3d& light) const {
  const bool above = light.z > 0;
  if (!above && lobe != glass && lobe != glass_again) return 0;
  switch (lobe) {
    case coat:
    case specular: {
      const GgxFacets& facets = lobe == coat ? coat_facets_ : facets_;
      const Vec3d h = normalize(view_ + light);
      return facets.g1(view_) * facets.distribution(h) / (4 * view_.z);
    }
    case diffuse:
      return light.z / kPi;
    case cloth:
      return Sheen::density(light.z);
    case multiple:
      return often_density(light.z);
    case glass: {
      const auto facet = glass_facet(view_, light, eta_);
      if (!facet) return 0;
      const auto& [h, vh, lh] = *facet;
      const double f = brdf::fresnel_dielectric(std::min(vh, 1.0), eta_), p = facets_.visible(view_, h);
      if (above) return f * p / (4 * vh);
      return (1 - f) * p * squared(eta_) * -lh / squared(vh + eta_ * lh);
    }
    case glass_again:
      return (above ? 1 - again_through_ : again_through_) * often_density(std::abs(light.z));
    default:
      return 0;
  }
}

Radiance Bsdf::evaluate(const Vec3d& light) const {
  const Vec3d local = to_local(light);
  Radiance sum{};
  if (!on_one_side(light, local)) return sum;
  for (const Lobe lobe : kAll)
    if (probability_[lobe] > 0 && !is_mirror(lobe)) sum = sum + value(lobe, local);
  return sum;
}

double Bsdf::pdf(const Vec3d& light) const {
  const Vec3d local = to_local(light);
  double sum = 0;
  for (const Lobe lobe : kAll)
    if (probability_[lobe] > 0 && !is_mirror(lobe)) sum += probability_[lobe] * density(lobe, local);
  return sum;
}

Vec3d Bsdf::flat_side(const Vec3d& world) const {
  // A mirror's ray that interpolated normals send into the triangle's plane stays on its side.
  const double depth = dot(world, flat_);
  return depth < 0 ? normalize(world - (2 * depth) * flat_) : world;
}

std::optional<BsdfSample> Bsdf::mirrored(Lobe lobe, double u) const {
  const Vec3d up{0, 0, 1};
  const double weight = brdf::schlick_weight(view_.z);
  BsdfSample sample{flat_side(to_world(reflect(view_, up))), {}, 0, true, false};
  if (lobe == coat) {
    const double value = coat_ * (kCoatF0 + (1 - kCoatF0) * weight);
    sample.weight = {value, value, value};
    return sample;
  }
  const double passed = below_coat(view_.z);
  if (lobe == specular) {
    for (std::size_t i = 0; i < 3; ++i)
      sample.weight[i] = opaque_ * passed * (f0_[i] + (f90_ - f0_[i]) * weight);
    return sample;
  }
  const double f = brdf::fresnel_dielectric(view_.z, eta_), value = glass_ * passed;
  if (u < f) {
    sample.weight = {value, value, value};
    return sample;
  }
  const auto bent = bend(view_, up, eta_);
  if (!bent) return std::nullopt;
  const Vec3d world = to_world(*bent);
  const double depth = dot(world, flat_);
  sample.direction = depth > 0 ? normalize(world - (2 * depth) * flat_) : world;
  sample.weight = (value / squared(eta_)) * tint_;
  sample.through = true;
  return sample;
}

std::optional<Vec3d> Bsdf::drawn(Lobe lobe, double u, double u1, double u2) const {
  const auto above = [](const Vec3d& light) { return light.z > 0 ? std::optional(light) : std::nullopt; };
  switch (lobe) {
    case coat:
      return above(reflect(view_, coat_facets_.draw(view_, u1, u2)));
    case specular:
      return above(reflect(view_, facets_.draw(view_, u1, u2)));
    case diffuse:
      return cosine_direction(u1, u2);
    case cloth:
      return Sheen::draw(u1, u2);
    case multiple:
      return often_direction(u, u1, u2);
    case glass_again: {
      const bool through = u < again_through_;
      const double rest = through ? u / again_through_ : (u - again_through_) / (1 - again_through_);
      const Vec3d light = often_direction(rest, u1, u2);
      return through ? Vec3d{light.x, light.y, -light.z} : light;
    }
    case glass: {
      const Vec3d h = facets_.draw(view_, u1, u2);
      const double vh = dot(view_, h);
      if (vh <= 0) return std::nullopt;
      if (u >= brdf::fresnel_dielectric(std::min(vh, 1.0), eta_)) {
        const auto bent = bend(view_, h, eta_);
        return bent && bent->z < 0 ? bent : std::nullopt;
      }
      return above(reflect(view_, h));
    }
    default:
      return std::nullopt;
  }
}

std::optional<BsdfSample> Bsdf::sample(double lobe, double u1, double u2) const {
  int chosen = -1;
  for (int i = 0; i < kLobes; ++i) {
    const double p = probability_[static_cast<std::size_t>(i)];
    if (p == 0) continue;
    chosen = i;
    if (lobe < p) break;
    lobe -= p;
  }
  if (chosen < 0) return std::nullopt;
  const double p = probability_[static_cast<std::size_t>(chosen)];
  const double rest = std::clamp(lobe / p, 0.0, 1 - 0x1p-53);
  const auto kind = static_cast<Lobe>(chosen);
  if (is_mirror(kind)) {
    auto sample = mirrored(kind, rest);
    if (sample) sample->weight = (1 / p) * sample->weight;
    return sample;
  }
  const auto local = drawn(kind, rest, u1, u2);
  if (!local) return std::nullopt;
  const Vec3d world = to_world(*local);
  if (!on_one_side(world, *local)) return std::nullopt;
  BsdfSample sample{world, {}, pdf(world), false, local->z < 0};
  if (!(sample.pdf > 0)) return std::nullopt;
  sample.weight = (std::abs(local->z) / sample.pdf) * evaluate(world);
  return sample;
}

}  // namespace welkin::scene
