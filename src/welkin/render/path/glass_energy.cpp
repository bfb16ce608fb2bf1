#include "welkin/render/path/glass_energy.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>

#include "welkin/brdf/compensation.h"
#include "welkin/brdf/microfacet.h"
#include "welkin/render/path/ggx_lobe.h"
#include "welkin/render/path/refraction.h"

namespace welkin::scene {
namespace {

constexpr int kRoughnesses = 25, kCosines = 24, kDraws = 1024;
/// Flatter directions count as this one.
constexpr double kLeastCosine = 1e-4;

/// Where a table is read: between `index` and the next, `weight` the share of the next.
struct Place {
  std::size_t index;
  double weight;
};
Place place_of(double x, int steps) {
  const double scaled = std::clamp(x, 0.0, 1.0) * (steps - 1);
  const auto index = static_cast<std::size_t>(std::min(static_cast<int>(scaled), steps - 2));
  return {index, scaled - static_cast<double>(index)};
}
double between(double a, double b, double weight) {
  return a + weight * (b - a);
}

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

/// 2 ∫ L μ dμ where L is linear between values at equal steps of √μ: 4 ∫ L x³ dx, step by step.
double hemisphere_mean(const double* losses) {
  double sum = 0;
  for (int i = 0; i + 1 < kCosines; ++i) {
    const double a = i / (kCosines - 1.0), b = (i + 1) / (kCosines - 1.0), step = b - a;
    const double fourth = (std::pow(b, 4) - std::pow(a, 4)) / 4,
                 fifth = (std::pow(b, 5) - std::pow(a, 5)) / 5;
    const double slope = (losses[i + 1] - losses[i]) / step;
    sum += (losses[i] - slope * a) * fourth + slope * fifth;
  }
  return 4 * sum;
}

}  // namespace

GlassLoss::GlassLoss(double eta) : losses_(std::size_t{kRoughnesses} * kCosines), averages_(kRoughnesses) {
  for (std::size_t row = 1; row < averages_.size(); ++row) {  // smooth glass loses nothing
    const double roughness = static_cast<double>(row) / (kRoughnesses - 1);
    double* losses = losses_.data() + kCosines * row;
    for (int i = 0; i < kCosines; ++i) {
      const double root = i / (kCosines - 1.0), cosine = std::max(root * root, kLeastCosine);
      losses[i] = std::clamp(1 - seen_once(cosine, roughness * roughness, eta), 0.0, 1.0);
    }
    averages_[row] = hemisphere_mean(losses);
  }
}

double GlassLoss::at(double cosine, double roughness) const {
  const Place row = place_of(roughness, kRoughnesses);
  const Place column = place_of(std::sqrt(std::clamp(cosine, kLeastCosine, 1.0)), kCosines);
  const double* low = losses_.data() + row.index * kCosines + column.index;
  const double* high = low + kCosines;
  return between(between(low[0], low[1], column.weight), between(high[0], high[1], column.weight),
                 row.weight);
}

double GlassLoss::average(double roughness) const {
  const Place row = place_of(roughness, kRoughnesses);
  return between(averages_[row.index], averages_[row.index + 1], row.weight);
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
  static std::mutex mutex;
  static std::map<double, std::unique_ptr<const GlassEnergy>> made;
  const std::lock_guard lock(mutex);
  auto& energy = made[ior];
  if (!energy) energy = std::make_unique<const GlassEnergy>(ior);
  return *energy;
}

}  // namespace welkin::scene
