#include <algorithm>
#include <cstring>

#include "welkin/base/parallel.h"
#include "welkin/filter/resample_job.h"

namespace welkin {

void resample_rectangle(const ResampleJob& job, Fetch kernel, int chart, int x0, int y0, int width,
                        int height, Batch& batch) {
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
  for (int y = 0; y < height; ++y, pixels += row)
    std::memcpy(out.at(x0, y0 + y), pixels, row * sizeof(float));
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
          resample_rectangle(job, kernel, i / bands, x, y, std::min(kColumns, width - x),
                             std::min(kRows, height - y), batch);
        }
      },
      job.options.monitor);
}

}  // namespace welkin
