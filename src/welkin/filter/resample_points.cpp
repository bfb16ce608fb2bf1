#include <algorithm>
#include <cstring>

#include "welkin/base/parallel.h"
#include "welkin/filter/resample_job.h"

namespace welkin {

namespace {

/// Positions of the centres of a rectangle of target texels, row by row, and where they lie in the source.
void locate_centres(const ResampleJob& job, int chart, int x0, int y0, int width, int height, Batch& batch) {
  const float across = 1.0f / static_cast<float>(job.target.width());
  const float down = 1.0f / static_cast<float>(job.target.height());
  for (int x = 0; x < width; ++x) batch.u[x] = (static_cast<float>(x0 + x) + 0.5f) * across;
  for (int y = 0; y < height; ++y) {
    if (y > 0) std::copy_n(batch.u, width, batch.u + y * width);
    std::fill_n(batch.v + y * width, width, (static_cast<float>(y0 + y) + 0.5f) * down);
  }
  batch.locate(chart, static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
}

void copy_rows(const float* texels, ImageView<float> out) {
  const std::size_t row = static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.channels);
  for (int y = 0; y < out.height; ++y, texels += row) std::memcpy(out.row(y), texels, row * sizeof(float));
}

}  // namespace

void resample_rectangle(const ResampleJob& job, Fetch kernel, int chart, int x0, int y0, int width,
                        int height, Batch& batch) {
  locate_centres(job, chart, x0, y0, width, height, batch);
  const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  copy_rows(batch.fetch_texels(kernel, view_of(job.source.level), chart, count),
            job.target.level.chart(chart).part(x0, y0, width, height));
}

void resample_points(const ResampleJob& job, Fetch kernel) {
  // Tiles of 32 × 8 texels: what they read lies together along and across.
  constexpr int kRows = 8, kColumns = kBatch / kRows;
  static_assert(kColumns % sphere::kLanes == 0);
  const LevelView source = view_of(job.source.level);
  const int width = job.target.width(), height = job.target.height();
  const int bands = (height + kRows - 1) / kRows;
  parallel_for(
      job.target.charts() * bands,
      [&](int i) {
        const int chart = i / bands, y = i % bands * kRows, rows = std::min(kRows, height - y);
        Batch batch(job);
        for (int x = 0; x < width; x += kColumns) {
          const int columns = std::min(kColumns, width - x);
          if (columns < kColumns || job.fills()) {
            resample_rectangle(job, kernel, chart, x, y, columns, rows, batch);
            continue;
          }
          // Straight into the target. What a kernel writes past the end of a row is the next tile's, or
          // border.
          locate_centres(job, chart, x, y, columns, rows, batch);
          const ImageView<float> out = job.target.level.chart(chart).part(x, y, columns, rows);
          for (int row = 0; row < rows; ++row) {
            const int at = row * kColumns;
            kernel(source, batch.chart + at, batch.source_u + at, batch.source_v + at, out.row(row),
                   kColumns);
          }
        }
      },
      job.options.monitor);
}

}  // namespace welkin
