#include "welkin/prefilter/level_texels.h"

#include <algorithm>
#include <cstring>

#include "welkin/prefilter/kernels.h"

namespace welkin::prefilter {
namespace {

constexpr std::size_t kBatch = 256;

}  // namespace

void LevelTexels::rows(int chart, int from, int rows) const {
  const int width = result_.width(), height = result_.height(), n = result_.channels();
  alignas(64) float u[kBatch], v[kBatch], x[kBatch], y[kBatch], z[kBatch];
  alignas(64) float at_chart[kBatch], at_u[kBatch], at_v[kBatch];
  std::vector<float> values(kBatch * static_cast<std::size_t>(n) + 8), more(values.size());
  const auto& p = result_.parameterization;
  const std::size_t all = static_cast<std::size_t>(rows) * static_cast<std::size_t>(width);
  for (std::size_t first = 0; first < all; first += kBatch) {
    const std::size_t count = std::min(kBatch, all - first);
    for (std::size_t i = 0; i < sphere::padded(count); ++i) {
      const int k = static_cast<int>(first + std::min(i, count - 1));
      u[i] = (static_cast<float>(k % width) + 0.5f) / static_cast<float>(width);
      v[i] = (static_cast<float>(from + k / width) + 0.5f) / static_cast<float>(height);
    }
    p.kernels().to_sphere(p.self(), chart, u, v, x, y, z, count);
    if (rotated_) multiply(to_source_, x, y, z, sphere::padded(count));
    grid_shape_.kernels().from_sphere(grid_shape_.self(), x, y, z, at_chart, at_u, at_v, count);
    fetch_(view_, at_chart, at_u, at_v, values.data(), count);
    if (near_ != nullptr) {
      fetch_(view_of(*near_), at_chart, at_u, at_v, more.data(), count);
      for (std::size_t i = 0; i < count * static_cast<std::size_t>(n); ++i) values[i] += more[i];
    } else {
      add_bright(x, y, z, values.data(), count);
    }
    float minimum = 0;
    for (std::size_t i = 0; i < count * static_cast<std::size_t>(n); ++i)
      minimum = std::min(minimum, values[i]);
    if (minimum < 0 && is_nonnegative_()) {
      for (std::size_t i = 0; i < count * static_cast<std::size_t>(n); ++i)
        values[i] = std::max(values[i], 0.0f);
    }
    // Rows of a tile follow each other in the chart with its borders between.
    for (std::size_t i = 0; i < count;) {
      const int k = static_cast<int>(first + i);
      const std::size_t run = std::min(count - i, static_cast<std::size_t>(width - k % width));
      std::memcpy(result_.level.chart(chart).at(k % width, from + k / width),
                  values.data() + i * static_cast<std::size_t>(n),
                  run * static_cast<std::size_t>(n) * sizeof(float));
      i += run;
    }
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
