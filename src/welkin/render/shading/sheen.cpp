#include "welkin/render/shading/sheen.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>

#include "welkin/base/parallel.h"
#include "welkin/brdf/compensation.h"
#include "welkin/brdf/microfacet.h"
#include "welkin/render/cosine_table.h"

namespace welkin::scene {
namespace {

// Of the table: √n·v across, roughness down.
constexpr int kColumns = 64, kRows = 48;
constexpr double kLeastCosine = 1e-4;

/// Azimuths of the midpoint rule over 0 … π.
constexpr int kAzimuths = 96;

SheenSum mixed(const SheenSum& a, const SheenSum& b, double part) {
  const auto mix = [&](double x, double y) { return x + part * (y - x); };
  return {mix(a.unbounded, b.unbounded), mix(a.albedo, b.albedo), mix(a.largest, b.largest),
          mix(a.along_normal, b.along_normal), mix(a.along_view, b.along_view)};
}

/// ∫ D V dφ over the azimuth between two directions, and the same times cos φ.
struct AzimuthSum {
  double plain = 0, along = 0;
};
AzimuthSum azimuth_sum(double nv, double nl, double alpha) {
  const double sines = std::sqrt((1 - nv * nv) * (1 - nl * nl));
  AzimuthSum sum;
  for (int i = 0; i < kAzimuths; ++i) {
    const double cosine = std::cos(kPi * (i + 0.5) / kAzimuths);
    const double square = (nv + nl) * (nv + nl) / (2 + 2 * (nv * nl + sines * cosine));
    const double d = brdf::charlie_distribution_from_sine(std::max(0.0, 1 - square), alpha);
    sum.plain += d;
    sum.along += d * cosine;
  }
  const double weight = 2 * kPi / kAzimuths * brdf::neubelt_visibility(nl, nv);
  return {weight * sum.plain, weight * sum.along};
}

/// Σ weights f(μ) = ∫ f dμ over the columns' cosines: Simpson's rule in x = √μ, dμ = 2 x dx, its last three
/// intervals by the rule of 3/8.
std::array<double, kColumns> cosine_weights() {
  std::array<double, kColumns> weights{};
  constexpr double kStep = 1.0 / (kColumns - 1);
  static_assert(kColumns % 2 == 0 && kColumns > 4);
  for (int i = 0; i + 2 < kColumns - 3; i += 2)
    for (int k = 0; k < 3; ++k) weights[static_cast<std::size_t>(i + k)] += kStep / 3 * (k == 1 ? 4 : 1);
  for (int k = 0; k < 4; ++k)
    weights[static_cast<std::size_t>(kColumns - 4 + k)] += kStep * 3 / 8 * (k % 3 == 0 ? 1 : 3);
  for (int i = 0; i < kColumns; ++i) weights[static_cast<std::size_t>(i)] *= 2 * i * kStep;
  return weights;
}

/// The sums of one roughness.
void fill_row(double roughness, SheenSum* row) {
  static const std::array<double, kColumns> weights = cosine_weights();
  std::array<double, kColumns> cosines{};
  for (std::size_t i = 0; i < kColumns; ++i) {
    const double x = static_cast<double>(i) / (kColumns - 1);
    cosines[i] = std::clamp(x * x, kLeastCosine, 1.0);
  }
  std::vector<AzimuthSum> lobes(kColumns * kColumns);
  const auto lobe = [&](std::size_t v, std::size_t l) -> AzimuthSum& { return lobes[v * kColumns + l]; };
  for (std::size_t v = 0; v < kColumns; ++v)
    for (std::size_t l = 0; l <= v; ++l)
      lobe(v, l) = lobe(l, v) = azimuth_sum(cosines[v], cosines[l], roughness * roughness);
  for (std::size_t v = 0; v < kColumns; ++v)
    for (std::size_t l = 0; l < kColumns; ++l) row[v].unbounded += weights[l] * cosines[l] * lobe(v, l).plain;
  for (std::size_t v = 0; v < kColumns; ++v) {
    for (std::size_t l = 0; l < kColumns; ++l) {
      const double nl = cosines[l];
      const double weight = weights[l] * nl / std::max({1.0, row[v].unbounded, row[l].unbounded});
      row[v].albedo += weight * lobe(v, l).plain;
      row[v].along_normal += weight * lobe(v, l).plain * nl;
      row[v].along_view += weight * lobe(v, l).along * std::sqrt(1 - nl * nl);
    }
    row[v].along_normal /= row[v].albedo;
    row[v].along_view /= row[v].albedo;
  }
  for (std::size_t v = 0; v < kColumns; ++v)
    for (std::size_t l = 0; l < kColumns; ++l)
      row[v].largest += 2 * weights[l] * cosines[l] * std::max(row[v].albedo, row[l].albedo);
}

}  // namespace

SheenSums::SheenSums() : texels_(kColumns * kRows) {
  const auto fill = [&](int y) {
    const double roughness = kLeastSheenRoughness + (1 - kLeastSheenRoughness) * y / (kRows - 1);
    fill_row(roughness, &texels_[static_cast<std::size_t>(y * kColumns)]);
  };
  // A thread that waits inside must not take up work that asks for the sums again.
  tbb::this_task_arena::isolate([&] { parallel_for(kRows, fill); });
}

SheenSum SheenSums::at(double nv, double roughness) const {
  const auto [i, fx] = between(std::sqrt(std::clamp(nv, 0.0, 1.0)), kColumns);
  const auto [j, fy] = between((roughness - kLeastSheenRoughness) / (1 - kLeastSheenRoughness), kRows);
  const SheenSum* above = &texels_[static_cast<std::size_t>(j * kColumns + i)];
  const SheenSum* below = above + kColumns;
  return mixed(mixed(above[0], above[1], fx), mixed(below[0], below[1], fx), fy);
}

const SheenSums& sheen_sums() {
  static const SheenSums sums;
  return sums;
}

Sheen::Sheen(const MaterialPoint& at, double nv) {
  for (std::size_t c = 0; c < 3; ++c) {
    color_[c] = std::clamp<double>(at.sheen_color[c], 0, 1);
    most_ = std::max(most_, color_[c]);
  }
  if (most_ == 0) return;
  roughness_ = std::clamp<double>(at.sheen_roughness, kLeastSheenRoughness, 1);
  sum_ = sheen_sums().at(nv, roughness_);
}

double Sheen::passed(double nl) const {
  if (most_ == 0) return 1;
  return brdf::sheen_albedo_scaling(most_, sum_.albedo, sheen_sums().at(nl, roughness_).albedo);
}

Radiance Sheen::value(const Vec3d& view, const Vec3d& light) const {
  const Vec3d h = normalize(view + light);
  const double d =
      brdf::charlie_distribution_from_sine(std::max(0.0, h.x * h.x + h.y * h.y), roughness_ * roughness_);
  const double bound = std::max({1.0, sum_.unbounded, sheen_sums().at(light.z, roughness_).unbounded});
  return (d * brdf::neubelt_visibility(light.z, view.z) / bound) * color_;
}

// Between even and near the horizon, where smooth cloth shines: n·l is u^(3/2).
Vec3d Sheen::draw(double u1, double u2) {
  const double z = std::max(1e-12, u1 * std::sqrt(u1)), s = std::sqrt((1 - z) * (1 + z)), phi = 2 * kPi * u2;
  return {s * std::cos(phi), s * std::sin(phi), z};
}
double Sheen::density(double nl) {
  return 1 / (3 * kPi * std::cbrt(nl));
}

Sheen::LookUp Sheen::look_up(const Surface& at) const {
  const Vec3d level = at.view - dot(at.view, at.normal) * at.normal;
  const double size = length(level);
  const Vec3d mean = sum_.along_normal * at.normal + (size > 1e-9 ? sum_.along_view / size : 0) * level;
  // The lobe s^p (1 − s), p = 1/2α, has a mean direction of length B(p + 1, 3)/B(p + 1, 2) = 2/(p + 3).
  const double power = 2 / std::max(length(mean), 1e-6) - 3;
  const double alpha = power > 0.5 ? 0.5 / power : 1;
  return {normalize(mean), std::max(std::sqrt(alpha), kLeastSheenRoughness)};
}

}  // namespace welkin::scene
