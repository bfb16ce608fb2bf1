#include "welkin/render/shading/split_sums.h"

#include <algorithm>
#include <cmath>

#include "welkin/brdf/dfg_table.h"
#include "welkin/render/cosine_table.h"

namespace welkin::scene {
namespace {

constexpr int kSide = 128;

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
  const std::vector<double> weights = hemisphere_weights(kSide);
  for (int y = 0; y < kSide; ++y) {
    brdf::SplitSum sum;
    for (int x = 0; x < kSide; ++x) {
      const brdf::SplitSum value = texel(image_, x, y);
      sum.one += weights[static_cast<std::size_t>(x)] * value.one;
      sum.fc += weights[static_cast<std::size_t>(x)] * value.fc;
    }
    averages_.push_back(sum);
  }
}

brdf::SplitSum SplitSums::at(double nv, double roughness) const {
  const auto [i, fx] = between(std::sqrt(std::clamp(nv, 0.0, 1.0)), kSide);
  const auto [j, fy] = between(roughness, kSide);
  return mixed(mixed(texel(image_, i, j), texel(image_, i + 1, j), fx),
               mixed(texel(image_, i, j + 1), texel(image_, i + 1, j + 1), fx), fy);
}

brdf::SplitSum SplitSums::average(double roughness) const {
  const auto [j, part] = between(roughness, kSide);
  const auto row = static_cast<std::size_t>(j);
  return mixed(averages_[row], averages_[row + 1], part);
}

const SplitSums& split_sums() {
  static const SplitSums sums;
  return sums;
}

}  // namespace welkin::scene
