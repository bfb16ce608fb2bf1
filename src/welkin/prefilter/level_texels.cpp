#include "welkin/prefilter/level_texels.h"

#include <algorithm>
#include <cstring>

#include "welkin/prefilter/kernels.h"

namespace welkin::prefilter {

void LevelTexels::aim(int chart, int from, std::size_t first, Tile& tile) const {
  const int width = result_.width(), height = result_.height();
  alignas(64) float u[Tile::kMost], v[Tile::kMost];
  for (std::size_t i = 0; i < sphere::padded(tile.count); ++i) {
    const int k = static_cast<int>(first + std::min(i, tile.count - 1));
    u[i] = (static_cast<float>(k % width) + 0.5f) / static_cast<float>(width);
    v[i] = (static_cast<float>(from + k / width) + 0.5f) / static_cast<float>(height);
  }
  const auto& p = result_.parameterization;
  p.kernels().to_sphere(p.self(), chart, u, v, tile.x, tile.y, tile.z, tile.count);
  if (rotated_) multiply(to_source_, tile.x, tile.y, tile.z, sphere::padded(tile.count));
  grid_shape_.kernels().from_sphere(grid_shape_.self(), tile.x, tile.y, tile.z, tile.at_chart, tile.at_u,
                                    tile.at_v, tile.count);
}

void LevelTexels::fill(int chart, int from, std::size_t first, const Tile& tile, const float* bright,
                       std::size_t stride) const {
  const int width = result_.width(), n = result_.channels();
  const std::size_t size = tile.count * static_cast<std::size_t>(n);
  std::vector<float> values(Tile::kMost * static_cast<std::size_t>(n) + 8);
  fetch_(view_, tile.at_chart, tile.at_u, tile.at_v, values.data(), tile.count);
  if (near_ != nullptr) {
    std::vector<float> more(values.size());
    fetch_(view_of(*near_), tile.at_chart, tile.at_u, tile.at_v, more.data(), tile.count);
    for (std::size_t i = 0; i < size; ++i) values[i] += more[i];
  } else if (bright != nullptr) {
    for (std::size_t i = 0; i < size; ++i) values[i] += bright[i * stride];
  } else {
    add_bright(tile.x, tile.y, tile.z, values.data(), tile.count);
  }
  float minimum = 0;
  for (std::size_t i = 0; i < size; ++i) minimum = std::min(minimum, values[i]);
  if (minimum < 0 && is_nonnegative_()) {
    for (std::size_t i = 0; i < size; ++i) values[i] = std::max(values[i], 0.0f);
  }
  // Rows of a tile follow each other in the chart with its borders between.
  for (std::size_t i = 0; i < tile.count;) {
    const int k = static_cast<int>(first + i);
    const std::size_t run = std::min(tile.count - i, static_cast<std::size_t>(width - k % width));
    std::memcpy(result_.level.chart(chart).at(k % width, from + k / width),
                values.data() + i * static_cast<std::size_t>(n),
                run * static_cast<std::size_t>(n) * sizeof(float));
    i += run;
  }
}

void LevelTexels::rows(int chart, int from, int rows) const {
  const std::size_t all = static_cast<std::size_t>(rows) * static_cast<std::size_t>(result_.width());
  Tile tile;
  for (std::size_t first = 0; first < all; first += Tile::kMost) {
    tile.count = std::min(Tile::kMost, all - first);
    aim(chart, from, first, tile);
    fill(chart, from, first, tile, nullptr, 0);
  }
}

void GroupTexels::rows(int chart, int from, int rows) const {
  const LevelTexels& any = *members_.front();
  const std::size_t all = static_cast<std::size_t>(rows) * static_cast<std::size_t>(any.result().width());
  const lobe::Points points{bright_.x.data(),      bright_.y.data(), bright_.z.data(),
                            bright_.weight.data(), bright_.count(),  bright_.channels};
  std::vector<float> sums(LevelTexels::Tile::kMost * static_cast<std::size_t>(any.result().channels()) *
                          lobes_.members);
  LevelTexels::Tile tile;
  for (std::size_t first = 0; first < all; first += LevelTexels::Tile::kMost) {
    tile.count = std::min(LevelTexels::Tile::kMost, all - first);
    any.aim(chart, from, first, tile);
    kernels().group_sums(lobes_, points, tile.x, tile.y, tile.z, sums.data(), tile.count);
    for (std::size_t k = 0; k < members_.size(); ++k)
      members_[k]->fill(chart, from, first, tile, sums.data() + k, lobes_.members);
  }
}

void LevelTexels::add_bright(const float* x, const float* y, const float* z, float* values,
                             std::size_t count) const {
  if (level_.all || bright_.count() == 0) return;
  const lobe::Points points{bright_.x.data(), bright_.y.data(), bright_.z.data(),
                            weights_.data(),  bright_.count(),  bright_.channels};
  if (!level_.sampled) {
    level_.lobe.point_sums()(level_.lobe.self(), points, x, y, z, values, count);
  } else {
    kernels().sampled_sums(&*level_.sampled, points, x, y, z, values, count);
  }
}

}  // namespace welkin::prefilter
