#include "welkin/lookup/elliptical_sum.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "welkin/lookup/block_directions.h"

namespace welkin {
namespace {

/// σ at which weights end.
constexpr float kReach = 4;

/// What weights are computed from.
struct Quadric {
  Vec3<float> normal, right, down;
  float xx, xy, yy;  ///< Σ⁻¹, of which xy counts twice
};

Vec3<float> to_float(const Vec3d& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// e^(−x) for x ≥ 0, relative error 3e-7: 2^f by its series about 0 for −1 < f ≤ 0, times a power of two.
inline float exp_minus(float x) {
  const float scaled = std::min(x, 80.0f) * -1.44269504f;
  const std::int32_t whole = static_cast<std::int32_t>(scaled);
  const float f = (scaled - static_cast<float>(whole)) * 0.69314718f;
  float sum = 1.0f / 5040;
  sum = sum * f + 1.0f / 720;
  sum = sum * f + 1.0f / 120;
  sum = sum * f + 1.0f / 24;
  sum = sum * f + 1.0f / 6;
  sum = sum * f + 0.5f;
  sum = sum * f + 1;
  sum = sum * f + 1;
  return sum * std::bit_cast<float>((whole + 127) << 23);
}

/// acos(z)/√(1 − z) for 0 ≤ z ≤ 1, absolute error 2e-8 (Abramowitz & Stegun 1964, 4.4.46).
inline float arc_over_root(float z) {
  float sum = -0.0012624911f;
  sum = sum * z + 0.0066700901f;
  sum = sum * z - 0.0170881256f;
  sum = sum * z + 0.0308918810f;
  sum = sum * z - 0.0501743046f;
  sum = sum * z + 0.0889789874f;
  sum = sum * z - 0.2145988016f;
  return sum * z + 1.5707963050f;
}

/// (θ / sin θ)², θ the angle whose cosine is z.
inline float squared_stretch(float z) {
  // z ≥ 0: θ²/(1 − z²), of which (1 − z) cancels.
  const float magnitude = std::min(std::fabs(z), 1.0f);
  const float arc = arc_over_root(magnitude);
  const float near = arc * arc / (1 + magnitude);
  // z < 0: θ = π − acos(−z).
  const float theta = 3.14159265f - arc * std::sqrt(1 - magnitude);
  const float far = theta * theta / std::max(1 - magnitude * magnitude, 1e-7f);
  return z >= 0 ? near : far;
}

/// Weights of a block's texels, without their solid angles.
void weigh(const BlockDirections& at, const Quadric& q, std::size_t count, float* weights) {
  for (std::size_t i = 0; i < count; ++i) {
    const float x = at.x[i] * q.right.x + at.y[i] * q.right.y + at.z[i] * q.right.z;
    const float y = at.x[i] * q.down.x + at.y[i] * q.down.y + at.z[i] * q.down.z;
    const float z = at.x[i] * q.normal.x + at.y[i] * q.normal.y + at.z[i] * q.normal.z;
    const float distance = squared_stretch(z) * (q.xx * x * x + q.xy * x * y + q.yy * y * y);
    const float weight = exp_minus(0.5f * distance);
    weights[i] = distance <= kReach * kReach ? weight : 0.0f;
  }
}

}  // namespace

EllipticalSum::EllipticalSum(const sphere::AnyParameterization& p, const Level& level)
    : p_(p), level_(&level), blocks_(p, level) {}

bool EllipticalSum::add(const TangentPlane& plane, const Covariance& sigma, double share,
                        double* mean) const {
  const Ellipse ellipse = ellipse_of(sigma);
  const double determinant = sigma.xx * sigma.yy - sigma.xy * sigma.xy;
  const Quadric q{to_float(plane.normal),
                  to_float(plane.right),
                  to_float(plane.down),
                  static_cast<float>(sigma.yy / determinant),
                  static_cast<float>(-2 * sigma.xy / determinant),
                  static_cast<float>(sigma.xx / determinant)};
  const Vec3d across = -std::sin(ellipse.angle) * plane.right + std::cos(ellipse.angle) * plane.down;
  const auto reach = [](double width) { return static_cast<float>(std::min(kReach * width, kPi)); };
  const SphereStrip strip{q.normal, to_float(across), reach(ellipse.wide), reach(ellipse.narrow)};

  const int channels = level_->channels();
  std::array<double, kMaxChannels> sum{};
  double total = 0;
  blocks_.for_each(strip, [&](const TexelBlocks::Block& block) {
    BlockDirections at;
    at.find(p_, {level_->width(), level_->height()}, block);
    alignas(64) std::array<float, BlockDirections::kSize> weights;
    weigh(at, q, static_cast<std::size_t>(block.width * block.height), weights.data());
    std::size_t i = 0;
    const auto chart = level_->chart(block.chart);
    for (int row = 0; row < block.height; ++row) {
      const float* texel = chart.at(block.x, block.y + row);
      const float* solid_angles = blocks_.solid_angles(block.chart, block.x, block.y + row);
      for (int column = 0; column < block.width; ++column, ++i, texel += channels) {
        const double weight = static_cast<double>(weights[i] * solid_angles[column]);
        if (!(weight > 0)) continue;
        total += weight;
        for (int c = 0; c < channels; ++c)
          sum[static_cast<std::size_t>(c)] += weight * static_cast<double>(texel[c]);
      }
    }
  });
  if (!(total > 0)) return false;
  for (int c = 0; c < channels; ++c) mean[c] += share / total * sum[static_cast<std::size_t>(c)];
  return true;
}

}  // namespace welkin
