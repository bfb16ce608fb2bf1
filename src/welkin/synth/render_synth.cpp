#include "welkin/synth/render_synth.h"

#include <algorithm>
#include <string>
#include <vector>

#include "welkin/base/error.h"
#include "welkin/base/parallel.h"
#include "welkin/map/borders.h"

namespace welkin {
namespace {

constexpr int kMaxSamples = 64;
constexpr int kBatch = 256;

struct Mean {
  double weight = 0;
  double sum[3] = {0, 0, 0};
};

/// Texels (x, y) … (x + count − 1, y) of a chart, count ≤ kBatch.
void render_batch(const synth::Radiance& radiance, Map& map, const Matrix3& to_world, int samples, int chart,
                  int x, int y, int count) {
  alignas(64) float u[kBatch], v[kBatch], dx[kBatch], dy[kBatch], dz[kBatch], density[kBatch], valid[kBatch];
  const auto& p = map.parameterization;
  const std::size_t size = static_cast<std::size_t>(count);
  Mean means[kBatch];
  const auto set_positions = [&](double right, double down) {
    for (int i = 0; i < kBatch; ++i) {
      u[i] = static_cast<float>((x + std::min(i, count - 1) + right) / map.width());
      v[i] = static_cast<float>((y + down) / map.height());
    }
    p.kernels().valid(p.self(), chart, u, v, valid, size);
  };

  // Sum the samples: for each position within a texel, over all texels.
  for (int k = 0; k < samples * samples; ++k) {
    const int column = k % samples, row = k / samples;
    set_positions((column + (row + 0.5) / samples) / samples, (row + (column + 0.5) / samples) / samples);
    p.kernels().density(p.self(), chart, u, v, density, size);
    p.kernels().to_sphere(p.self(), chart, u, v, dx, dy, dz, size);
    for (int i = 0; i < count; ++i) {
      const double weight = static_cast<double>(density[i]);
      if (!(valid[i] > 0) || !(weight > 0)) continue;
      const Vec3d d{static_cast<double>(dx[i]), static_cast<double>(dy[i]), static_cast<double>(dz[i])};
      const std::array<float, 3> value = radiance(to_world * normalize(d));
      means[i].weight += weight;
      for (std::size_t c = 0; c < 3; ++c) means[i].sum[c] += weight * static_cast<double>(value[c]);
    }
  }

  set_positions(0.5, 0.5);
  float* out = map.level.chart(chart).at(x, y);
  for (int i = 0; i < count; ++i, out += 3) {
    if (!(valid[i] > 0) || !(means[i].weight > 0)) continue;
    for (int c = 0; c < 3; ++c) out[c] = static_cast<float>(means[i].sum[c] / means[i].weight);
  }
}

}  // namespace

Map render(const synth::Radiance& radiance, const sphere::AnyParameterization& parameterization, int width,
           int height, const RenderOptions& options) {
  if (options.samples < 1 || options.samples > kMaxSamples) {
    throw Error(ErrorKind::bad_request, "samples along a texel's side must be 1 to " +
                                            std::to_string(kMaxSamples) + ", not " +
                                            std::to_string(options.samples));
  }
  if (!is_orthonormal(options.orientation))
    throw Error(ErrorKind::bad_request, "the orientation of a map must be a rotation or a reflection");
  Map map(parameterization, width, height, 3);
  map.orientation = options.orientation;
  const Matrix3 to_world = transpose(options.orientation);
  parallel_for(
      map.charts() * height,
      [&](int row) {
        for (int x = 0; x < width; x += kBatch) {
          render_batch(radiance, map, to_world, options.samples, row / height, x, row % height,
                       std::min(kBatch, width - x));
        }
      },
      options.monitor);
  fill_borders(map);
  return map;
}

}  // namespace welkin
