#include "welkin/lookup/elliptical_sum.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "welkin/lookup/block_directions.h"
#include "welkin/math/vec_precision.h"

namespace welkin {
namespace {

/// σ at which weights end.
constexpr float kReach = 4;

/// Adds weight × solid angle × radiance of a row of texels, and the weights. `kChannels` is 0 where their
/// number is known at run time alone.
template <int kChannels>
void add_row(const float* texel, const float* weights, const float* solid_angles, int count, int channels,
             double* sum) {
  const int each = kChannels > 0 ? kChannels : channels;
  float row[kMaxChannels] = {};
  float total = 0;
  for (int i = 0; i < count; ++i, texel += each) {
    const float weight = weights[i] * solid_angles[i];
    total += weight;
    for (int c = 0; c < each; ++c) row[c] += weight * texel[c];
  }
  for (int c = 0; c < each; ++c) sum[c] += static_cast<double>(row[c]);
  sum[each] += static_cast<double>(total);
}

using AddRow = void (*)(const float* texel, const float* weights, const float* solid_angles, int count,
                        int channels, double* sum);

AddRow add_row_of(int channels) {
  switch (channels) {
    case 1:
      return &add_row<1>;
    case 3:
      return &add_row<3>;
    case 4:
      return &add_row<4>;
    default:
      return &add_row<0>;
  }
}

}  // namespace

EllipticalSum::EllipticalSum(const sphere::AnyParameterization& p, const Level& level)
    : p_(p),
      level_(&level),
      blocks_(p, level),
      weigh_(weigh_directions()),
      add_row_(add_row_of(level.channels())) {}

bool EllipticalSum::add(const TangentPlane& plane, const Covariance& sigma, double share,
                        double* mean) const {
  const Ellipse ellipse = ellipse_of(sigma);
  const double determinant = sigma.xx * sigma.yy - sigma.xy * sigma.xy;
  const EllipticalWeight weight{to_float(plane.normal),
                                to_float(plane.right),
                                to_float(plane.down),
                                static_cast<float>(sigma.yy / determinant),
                                static_cast<float>(-2 * sigma.xy / determinant),
                                static_cast<float>(sigma.xx / determinant),
                                kReach};
  const Vec3d across = -std::sin(ellipse.angle) * plane.right + std::cos(ellipse.angle) * plane.down;
  const auto reach = [](double width) { return static_cast<float>(std::min(kReach * width, kPi)); };
  const SphereStrip strip{weight.normal, to_float(across), reach(ellipse.wide), reach(ellipse.narrow)};

  const int channels = level_->channels();
  std::array<double, kMaxChannels + 1> sum{};  // the last: of the weights
  blocks_.for_each(strip, [&](const TexelBlocks::Block& block) {
    BlockDirections at;
    at.find(p_, {level_->width(), level_->height()}, block);
    alignas(64) std::array<float, BlockDirections::kSize> weights;
    weigh_(weight, at.x.data(), at.y.data(), at.z.data(), weights.data(),
           static_cast<std::size_t>(block.width * block.height));
    const auto chart = level_->chart(block.chart);
    for (int row = 0; row < block.height; ++row) {
      add_row_(chart.at(block.x, block.y + row), weights.data() + row * block.width,
               blocks_.solid_angles(block.chart, block.x, block.y + row), block.width, channels, sum.data());
    }
  });
  const double total = sum[static_cast<std::size_t>(channels)];
  if (!(total > 0)) return false;
  for (int c = 0; c < channels; ++c) mean[c] += share / total * sum[static_cast<std::size_t>(c)];
  return true;
}

}  // namespace welkin
