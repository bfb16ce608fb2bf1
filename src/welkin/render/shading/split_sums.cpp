#include "welkin/render/shading/split_sums.h"

#include <algorithm>
#include <cmath>

#include "welkin/brdf/dfg_table.h"

namespace welkin::scene {
namespace {

constexpr int kSide = 128;

/// A texel before a place in 0 … 1, and how far the place is from it to the next.
struct Between {
  int first;
  double part;
};
Between between(double place) {
  const double x = std::clamp(place, 0.0, 1.0) * (kSide - 1);
  const int first = std::min(static_cast<int>(x), kSide - 2);
  return {first, x - first};
}

brdf::SplitSum mixed(const brdf::SplitSum& a, const brdf::SplitSum& b, double part) {
  return {a.one + part * (b.one - a.one), a.fc + part * (b.fc - a.fc)};
}

brdf::SplitSum texel(const Image& image, int x, int y) {
  const float* value = image.at(x, y);
  return {value[0], value[1]};
}

}  // namespace

SplitSums::SplitSums() {
  brdf::DfgTable table;
  table.width = table.height = kSide;
  table.cosine = brdf::CosineScale::root;
  table.placement = brdf::TexelPlacement::ends;
  table.channels = {brdf::DfgChannel::one, brdf::DfgChannel::bias};
  image_ = brdf::make_dfg_table(table);
  // With x = √μ, 2 μ dμ = 4 x³ dx; between two texels the integrand is a polynomial of degree 4, for
  // which Gauss's rule of three points is exact.
  constexpr double kNodes[3] = {0.1127016653792583, 0.5, 0.8872983346207417};
  constexpr double kWeights[3] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
  for (int y = 0; y < kSide; ++y) {
    brdf::SplitSum sum;
    for (int i = 0; i < kSide - 1; ++i) {
      for (int k = 0; k < 3; ++k) {
        const double x = (i + kNodes[k]) / (kSide - 1), weight = 4 * x * x * x * kWeights[k] / (kSide - 1);
        const brdf::SplitSum value = mixed(texel(image_, i, y), texel(image_, i + 1, y), kNodes[k]);
        sum.one += weight * value.one;
        sum.fc += weight * value.fc;
      }
    }
    averages_.push_back(sum);
  }
}

brdf::SplitSum SplitSums::at(double nv, double roughness) const {
  const auto [i, fx] = between(std::sqrt(std::clamp(nv, 0.0, 1.0)));
  const auto [j, fy] = between(roughness);
  return mixed(mixed(texel(image_, i, j), texel(image_, i + 1, j), fx),
               mixed(texel(image_, i, j + 1), texel(image_, i + 1, j + 1), fx), fy);
}

brdf::SplitSum SplitSums::average(double roughness) const {
  const auto [j, part] = between(roughness);
  const auto row = static_cast<std::size_t>(j);
  return mixed(averages_[row], averages_[row + 1], part);
}

const SplitSums& split_sums() {
  static const SplitSums sums;
  return sums;
}

}  // namespace welkin::scene
