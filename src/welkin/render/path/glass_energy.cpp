#include "welkin/render/path/glass_energy.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <numeric>

#include "welkin/brdf/compensation.h"
#include "welkin/brdf/microfacet.h"
#include "welkin/render/cosine_table.h"
#include "welkin/render/path/ggx_lobe.h"
#include "welkin/render/path/refraction.h"

namespace welkin::scene {
namespace {

constexpr int kRoughnesses = 25, kCosines = 24, kDraws = 1024;

/// The bits of k mirrored behind the point (van der Corput).
double mirrored_bits(unsigned k) {
  double value = 0;
  for (double place = 0.5; k != 0; k >>= 1, place /= 2) value += place * (k & 1U);
  return value;
}

/// E: facets are drawn as `view` sees them, by Hammersley's points; each reflects or lets through what the
/// other facets don't hide.
double seen_once(double cosine, double alpha, double eta) {
  const GgxFacets facets{alpha, alpha};
  const Vec3d view{std::sqrt((1 - cosine) * (1 + cosine)), 0, cosine};
  const double masked = facets.g1(view);
  double sum = 0;
  for (unsigned k = 0; k < kDraws; ++k) {
    const Vec3d h = facets.draw(view, (k + 0.5) / kDraws, mirrored_bits(k));
    const double vh = dot(view, h);
    if (vh <= 0) continue;
    const double f = brdf::fresnel_dielectric(std::min(vh, 1.0), eta);
    const Vec3d reflected = reflect(view, h);
    if (reflected.z > 0) sum += f * facets.g2(view, reflected) / masked;
    if (const auto bent = bend(view, h, eta); bent && bent->z < 0) sum += (1 - f) * facets.g1(*bent);
  }
  return sum / kDraws;
}

}  // namespace

GlassLoss::GlassLoss(double eta) : losses_(std::size_t{kRoughnesses} * kCosines), averages_(kRoughnesses) {
  const std::vector<double> weights = hemisphere_weights(kCosines);
  for (std::size_t row = 1; row < averages_.size(); ++row) {  // smooth glass loses nothing
    const double roughness = static_cast<double>(row) / (kRoughnesses - 1);
    double* losses = losses_.data() + kCosines * row;
    for (int i = 0; i < kCosines; ++i) {
      const double root = i / (kCosines - 1.0), cosine = std::max(root * root, kLeastCosine);
      losses[i] = std::clamp(1 - seen_once(cosine, roughness * roughness, eta), 0.0, 1.0);
    }
    averages_[row] = std::inner_product(weights.begin(), weights.end(), losses, 0.0);
  }
}

double GlassLoss::at(double cosine, double roughness) const {
  const auto [j, down] = between(roughness, kRoughnesses);
  const auto [i, right] = between(std::sqrt(std::clamp(cosine, kLeastCosine, 1.0)), kCosines);
  const double* low = losses_.data() + j * kCosines + i;
  const double* high = low + kCosines;
  return std::lerp(std::lerp(low[0], low[1], right), std::lerp(high[0], high[1], right), down);
}

double GlassLoss::average(double roughness) const {
  const auto [j, down] = between(roughness, kRoughnesses);
  const double* row = averages_.data() + j;
  return std::lerp(row[0], row[1], down);
}

GlassEnergy::GlassEnergy(double ior)
    : ior_(ior),
      outside_(ior),
      inside_(1 / ior),
      mean_let_through_(1 - brdf::average_fresnel(brdf::f0_of_eta<double>(ior))) {}

double GlassEnergy::through(bool from_behind, double roughness) const {
  const double outside = outside_.average(roughness), inside = ior_ * ior_ * inside_.average(roughness);
  if (outside <= 0 || inside <= 0) return 0;
  // What is let through outwards and inwards must be as `inside` to `outside`; neither is above the mean.
  return mean_let_through_ *
         (from_behind ? std::min(1.0, outside / inside) : std::min(1.0, inside / outside));
}

const GlassEnergy& glass_energy(double ior) {
  // Paths ask at each surface of glass, nearly always for the index that they asked for before.
  thread_local double last_ior = 0;
  thread_local const GlassEnergy* last = nullptr;
  if (last != nullptr && last_ior == ior) return *last;
  static std::mutex mutex;
  static std::map<double, std::unique_ptr<const GlassEnergy>> made;
  const std::lock_guard lock(mutex);
  auto& energy = made[ior];
  if (!energy) energy = std::make_unique<const GlassEnergy>(ior);
  last_ior = ior;
  last = energy.get();
  return *last;
}

}  // namespace welkin::scene
