#include <algorithm>
#include <cassert>
#include <cstring>

#include "welkin/map/resample_job.h"

namespace welkin {

ResampleJob::ResampleJob(const Map& from, Map& to, const ResampleOptions& how)
    : source(from),
      target(to),
      options(how),
      to_source(from.orientation * transpose(how.rotation) * transpose(to.orientation)),
      turned(!(to_source == Matrix3{})),
      target_is_full(to.parameterization.full_charts()),
      source_is_whole(from.parameterization.whole_world()),
      kernels(fetch_kernels(from.channels())),
      fill(how.fill) {
  assert(from.channels() == to.channels());
  fill.resize(static_cast<std::size_t>(from.channels()), 0.0f);
}

Fetch ResampleJob::fetch_of(Filter filter) const {
  const auto choose = [&](const RingingFetch& kernel) { return options.allow_ringing ? kernel.plain : kernel.held; };
  switch (filter) {
    case Filter::nearest: return kernels.nearest;
    case Filter::bilinear: return kernels.bilinear;
    case Filter::bicubic: return choose(kernels.bicubic);
    case Filter::lanczos: return choose(kernels.lanczos3);
    case Filter::automatic: break;
  }
  return choose(kernels.lanczos4);
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
  if (job_.turned) rotate(sphere::padded(count));
  s.kernels().from_sphere(s.self(), x_, y_, z_, chart, source_u, source_v, count);
}

void Batch::rotate(std::size_t count) {
  float f[3][3];
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) f[i][j] = static_cast<float>(job_.to_source.rows[i][j]);
  }
  for (std::size_t i = 0; i < count; ++i) {
    const float x = x_[i], y = y_[i], z = z_[i];
    x_[i] = f[0][0] * x + f[0][1] * y + f[0][2] * z;
    y_[i] = f[1][0] * x + f[1][1] * y + f[1][2] * z;
    z_[i] = f[2][0] * x + f[2][1] * y + f[2][2] * z;
  }
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

const float* Batch::fetch_texels(Fetch kernel, const LevelView& level, int target_chart, std::size_t count) {
  fetch(kernel, level, count);
  if (!job_.target_is_full) {
    const auto& t = job_.target.parameterization;
    t.kernels().valid(t.self(), target_chart, u, v, mask_, count);
    fill_where_zero(mask_, count);
  }
  return pixels_.data();
}

void resample_rectangle(const ResampleJob& job, Fetch kernel, int chart, int x0, int y0, int width, int height,
                        Batch& batch) {
  const float across = 1.0f / static_cast<float>(job.target.width());
  const float down = 1.0f / static_cast<float>(job.target.height());
  std::size_t count = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x, ++count) {
      batch.u[count] = (static_cast<float>(x0 + x) + 0.5f) * across;
      batch.v[count] = (static_cast<float>(y0 + y) + 0.5f) * down;
    }
  }
  batch.locate(chart, count);
  const float* pixels = batch.fetch_texels(kernel, view_of(job.source.level), chart, count);
  const ImageView<float> out = job.target.level.chart(chart);
  const std::size_t row = static_cast<std::size_t>(width) * job.channels();
  for (int y = 0; y < height; ++y, pixels += row) std::memcpy(out.at(x0, y0 + y), pixels, row * sizeof(float));
}

void resample_points(const ResampleJob& job, Fetch kernel) {
  // Tiles of 32 × 8 texels: what they read lies together along and across.
  constexpr int kRows = 8, kColumns = kBatch / kRows;
  const int width = job.target.width(), height = job.target.height();
  const int bands = (height + kRows - 1) / kRows;
  parallel_for(
      job.target.charts() * bands,
      [&](int i) {
        const int y = i % bands * kRows;
        Batch batch(job);
        for (int x = 0; x < width; x += kColumns) {
          resample_rectangle(job, kernel, i / bands, x, y, std::min(kColumns, width - x), std::min(kRows, height - y),
                             batch);
        }
      },
      job.options.monitor);
}

}  // namespace welkin
