#include <algorithm>
#include <cstring>
#include <utility>

#include "welkin/filter/resample_job.h"

namespace welkin {

namespace {

/// Positions of the centres of texels, row by row of the picture, and where they lie in the source.
void locate_centres(const ResampleJob& job, const ChartPart& part, int width, int height, Batch& batch) {
  if (job.options.positions) return batch.recall(part, width, height);
  const float across = 1.0f / static_cast<float>(job.target.size.width);
  const float down = 1.0f / static_cast<float>(job.target.size.height);
  const auto u = [&](int x, int y) { return (static_cast<float>(part.walk.image_x(x, y)) + 0.5f) * across; };
  const auto v = [&](int x, int y) { return (static_cast<float>(part.walk.image_y(x, y)) + 0.5f) * down; };
  // Along a row of the picture either u or v stays the same; the other is the same in each row.
  const bool on_its_side = part.walk.on_its_side();
  float* const along = on_its_side ? batch.v : batch.u;
  float* const still = on_its_side ? batch.u : batch.v;
  for (int x = 0; x < width; ++x) along[x] = on_its_side ? v(x, 0) : u(x, 0);
  for (int y = 0; y < height; ++y) {
    if (y > 0) std::copy_n(along, width, along + y * width);
    std::fill_n(still + y * width, width, on_its_side ? u(0, y) : v(0, y));
  }
  batch.locate(part.chart, static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
}

void copy_rows(const float* texels, ImageView<float> out) {
  const std::size_t row = static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.channels);
  for (int y = 0; y < out.height; ++y, texels += row) std::memcpy(out.row(y), texels, row * sizeof(float));
}

class PointMaker final : public TexelMaker {
 public:
  PointMaker(ResampleJob job, Fetch kernel) : job_(std::move(job)), kernel_(kernel) {}

  int rows() const override { return kRows; }

  void make(const ChartPart& part, ImageView<float> out) const override {
    Batch batch(job_);
    for (int y = 0; y < out.height; y += kRows) {
      const int rows = std::min(kRows, out.height - y);
      make_band(part.from(0, y), out.part(0, y, out.width, rows), batch);
    }
  }

 private:
  /// Straight into the picture, by positions where they are kept.
  void read_kept(const LevelView& source, const ChartPart& part, ImageView<float> out, Batch& batch) const {
    const TexelPositions& kept = *job_.options.positions;
    const int x = part.walk.start_x;
    std::fill_n(batch.chart, kBatch, 0.0f);
    for (int row = 0; row < out.height; ++row) {
      const int y = part.walk.start_y + row;
      const float* const charts = kept.chart(part.chart, y);
      kernel_(source, charts != nullptr ? charts + x : batch.chart, kept.u(part.chart, y) + x,
              kept.v(part.chart, y) + x, out.row(row), static_cast<std::size_t>(out.width));
    }
  }

  /// Tiles of 32 × 8 texels: what they read lies together along and across.
  static constexpr int kRows = 8;
  static constexpr int kMaxOverrun = 8;  ///< values that a kernel writes past its last one

  void make_band(const ChartPart& part, ImageView<float> out, Batch& batch) const {
    const LevelView source = view_of(job_.source.level);
    constexpr int kLanes = static_cast<int>(sphere::kLanes);
    const int most = kBatch / out.height / kLanes * kLanes;
    for (int x = 0; x < out.width; x += most) {
      const int columns = std::min(most, out.width - x);
      const ImageView<float> tile = out.part(x, 0, columns, out.height);
      const bool room_after = (out.width - x - columns) * out.channels >= kMaxOverrun;
      if (!room_after || job_.fills()) {
        resample_rectangle(job_, kernel_, part.from(x, 0), tile, batch);
        continue;
      }
      if (job_.options.positions && part.walk.as_it_is()) {
        read_kept(source, part.from(x, 0), tile, batch);
        continue;
      }
      // Straight into the picture. What a kernel writes past the end of a row is the next tile's.
      locate_centres(job_, part.from(x, 0), columns, out.height, batch);
      for (int row = 0; row < out.height; ++row) {
        const int at = row * columns;
        kernel_(source, batch.chart + at, batch.source_u + at, batch.source_v + at, tile.row(row),
                static_cast<std::size_t>(columns));
      }
    }
  }

  const ResampleJob job_;
  const Fetch kernel_;
};

}  // namespace

void resample_rectangle(const ResampleJob& job, Fetch kernel, const ChartPart& part, ImageView<float> out,
                        Batch& batch) {
  locate_centres(job, part, out.width, out.height, batch);
  const std::size_t count = static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height);
  copy_rows(batch.fetch_texels(kernel, view_of(job.source.level), part.chart, count), out);
}

std::unique_ptr<TexelMaker> make_by_points(ResampleJob job, Fetch kernel) {
  return std::make_unique<PointMaker>(std::move(job), kernel);
}

}  // namespace welkin
