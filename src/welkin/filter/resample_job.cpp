#include "welkin/filter/resample_job.h"

#include <algorithm>
#include <cmath>

#include "welkin/base/error.h"
#include "welkin/map/texel_points.h"

namespace welkin {

ResampleJob::ResampleJob(const Map& from, const MapFrame& to, const ResampleOptions& how)
    : source(from),
      target(to),
      options(how),
      to_source(rotation_to_source(from.orientation, to.orientation, how.rotation)),
      turned(!(to_source == Matrix3{})),
      target_is_full(to.parameterization.full_charts()),
      source_is_whole(from.parameterization.whole_world()),
      kernels(fetch_kernels(from.channels())),
      fill(how.fill) {
  fill.resize(static_cast<std::size_t>(from.channels()), 0.0f);
}

Fetch ResampleJob::fetch_of(Filter filter) const {
  if (filter != Filter::automatic) return fetch_for(filter, options.allow_ringing, source.channels());
  return options.allow_ringing ? kernels.lanczos4.unclamped : kernels.lanczos4.clamped;
}

void Batch::locate(int target_chart, std::size_t count) {
  const auto& t = job_.target.parameterization;
  const auto& s = job_.source.parameterization;
  // Samples that fill up the last pack repeat a real one.
  for (std::size_t i = count; i < sphere::padded(count); ++i) {
    u[i] = u[count - 1];
    v[i] = v[count - 1];
  }
  t.kernels().to_sphere(t.self(), target_chart, u, v, x_, y_, z_, count);
  if (job_.turned) multiply(job_.to_source, x_, y_, z_, sphere::padded(count));
  s.kernels().from_sphere(s.self(), x_, y_, z_, chart, source_u, source_v, count);
}

void Batch::weigh(int target_chart, std::size_t count) {
  const auto& t = job_.target.parameterization;
  t.kernels().density(t.self(), target_chart, u, v, weight, count);
  // At a pole the density rounds to either side of zero.
  for (std::size_t i = 0; i < count; ++i) weight[i] = std::max(weight[i], 0.0f);
  if (job_.target_is_full) return;
  t.kernels().valid(t.self(), target_chart, u, v, mask_, count);
  for (std::size_t i = 0; i < count; ++i) weight[i] = mask_[i] > 0 ? weight[i] : 0.0f;
}

const float* Batch::covered(std::size_t count) {
  const auto& s = job_.source.parameterization;
  s.kernels().covers(s.self(), x_, y_, z_, mask_, count);
  return mask_;
}

void Batch::fill_where_zero(const float* mask, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    if (!(mask[i] > 0)) std::copy(job_.fill.begin(), job_.fill.end(), pixels_.data() + i * job_.channels());
  }
}

const float* Batch::fetch(Fetch kernel, const LevelView& level, std::size_t count) {
  kernel(level, chart, source_u, source_v, pixels_.data(), count);
  if (!job_.source_is_whole) fill_where_zero(covered(count), count);
  return pixels_.data();
}

void Batch::recall(const ChartPart& part, int width, int height) {
  const TexelPositions& kept = *job_.options.positions;
  std::size_t i = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x, ++i) {
      const int column = part.walk.image_x(x, y), row = part.walk.image_y(x, y);
      const float* const charts = kept.chart(part.chart, row);
      source_u[i] = kept.u(part.chart, row)[column];
      source_v[i] = kept.v(part.chart, row)[column];
      chart[i] = charts != nullptr ? charts[column] : 0.0f;
    }
  }
  const std::size_t padded = sphere::padded(i);
  for (float* values : {chart, source_u, source_v}) std::fill(values + i, values + padded, values[i - 1]);
}

const float* Batch::fetch_texels(Fetch kernel, const LevelView& level, int target_chart, std::size_t count) {
  if (job_.options.positions) {
    kernel(level, chart, source_u, source_v, pixels_.data(), count);
    for (std::size_t i = 0; i < count; ++i) mask_[i] = std::isnan(source_u[i]) ? 0.0f : 1.0f;
    if (job_.fills()) fill_where_zero(mask_, count);
    return pixels_.data();
  }
  fetch(kernel, level, count);
  if (!job_.target_is_full && !job_.target.parameterization.filled_to_edges()) {
    const auto& t = job_.target.parameterization;
    t.kernels().valid(t.self(), target_chart, u, v, mask_, count);
    const auto [width, height] = job_.target.size;
    for (std::size_t i = 0; i < count; ++i) {
      if (mask_[i] > 0) continue;
      const int x = static_cast<int>(u[i] * static_cast<float>(width)),
                y = static_cast<int>(v[i] * static_cast<float>(height));
      if (!is_outside_texel(t, job_.target.size, target_chart, x, y)) mask_[i] = 1;
    }
    fill_where_zero(mask_, count);
  }
  return pixels_.data();
}

}  // namespace welkin
