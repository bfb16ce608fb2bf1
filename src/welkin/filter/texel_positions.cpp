#include "welkin/filter/texel_positions.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "welkin/base/error.h"
#include "welkin/base/parallel.h"
#include "welkin/filter/resample_job.h"
#include "welkin/map/texel_points.h"
#include "welkin/sphere/kernels.h"

namespace welkin {
namespace {

bool are_same(const MapFrame& a, const MapFrame& b) {
  return a.parameterization == b.parameterization && a.size.width == b.size.width &&
         a.size.height == b.size.height && a.orientation == b.orientation;
}

}  // namespace

TexelPositions::TexelPositions(const MapFrame& source, const MapFrame& target, const Matrix3& rotation)
    : source_(source), target_(target), rotation_(rotation) {
  require(is_orthonormal(rotation), "a world is turned by a rotation or a reflection");
  const int width = target.size.width, height = target.size.height;
  const int charts = target.parameterization.charts();
  u_ = Image(width, charts * height, 1, PixelContents::unset);
  v_ = Image(width, charts * height, 1, PixelContents::unset);
  if (source.parameterization.charts() > 1) chart_ = Image(width, charts * height, 1, PixelContents::unset);
  const Matrix3 to_source = rotation_to_source(source.orientation, target.orientation, rotation);
  parallel_for(charts * height, [&](int i) { locate_row(to_source, i / height, i % height); });
}

void TexelPositions::locate_row(const Matrix3& to_source, int chart, int y) {
  const auto& from = source_.parameterization;
  const auto& to = target_.parameterization;
  const auto [width, height] = target_.size;
  const bool turned = !(to_source == Matrix3{});
  const bool all_shown = from.whole_world(), all_valid = to.full_charts() || to.filled_to_edges();
  const float across = 1.0f / static_cast<float>(width);
  const float down = (static_cast<float>(y) + 0.5f) * (1.0f / static_cast<float>(height));
  alignas(64) float u[kBatch], v[kBatch], dx[kBatch], dy[kBatch], dz[kBatch], charts[kBatch], shown[kBatch],
      valid[kBatch];
  for (int start = 0; start < width; start += kBatch) {
    const int count = std::min(kBatch, width - start);
    const auto n = static_cast<std::size_t>(count);
    const auto padded = static_cast<int>(sphere::padded(n));
    for (int x = 0; x < padded; ++x) {
      u[x] = (static_cast<float>(start + std::min(x, count - 1)) + 0.5f) * across;
      v[x] = down;
    }
    if (!all_valid) {
      to.kernels().valid(to.self(), chart, u, v, valid, n);
      add_rim_texels(to, target_.size, chart, start, y, count, valid);
    }
    to.kernels().to_sphere(to.self(), chart, u, v, dx, dy, dz, n);
    if (turned) multiply(to_source, dx, dy, dz, sphere::padded(n));
    if (!all_shown) from.kernels().covers(from.self(), dx, dy, dz, shown, n);
    from.kernels().from_sphere(from.self(), dx, dy, dz, charts, u, v, n);
    for (int x = 0; x < count; ++x) {
      if ((!all_valid && !(valid[x] > 0)) || (!all_shown && !(shown[x] > 0)))
        u[x] = std::numeric_limits<float>::quiet_NaN();
    }
    const int row = chart * height + y;
    std::copy_n(u, count, u_.at(start, row));
    std::copy_n(v, count, v_.at(start, row));
    if (!chart_.empty()) std::copy_n(charts, count, chart_.at(start, row));
  }
}

bool TexelPositions::fit(const MapFrame& source, const MapFrame& target, const Matrix3& rotation) const {
  return are_same(source, source_) && are_same(target, target_) && rotation == rotation_;
}

}  // namespace welkin
