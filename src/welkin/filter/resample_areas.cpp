#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "welkin/base/parallel.h"
#include "welkin/filter/area.h"
#include "welkin/filter/footprint.h"
#include "welkin/filter/resample_job.h"
#include "welkin/map/pyramid.h"

namespace welkin {
namespace {

/// Where a grid of points of the target lies in the source, and the weight of each: 0 where it is not valid
/// in the target, or the source doesn't show it.
struct Grid {
  std::vector<float> chart, u, v, weight;
};

/// A rectangle of a chart's texels that is made.
struct Canvas {
  ImageView<float> texels;
  int x = 0, y = 0;  ///< of its first texel in the chart

  float* at(int chart_x, int chart_y) const { return texels.at(chart_x - x, chart_y - y); }
  ImageView<float> part(int chart_x, int chart_y, int width, int height) const {
    return texels.part(chart_x - x, chart_y - y, width, height);
  }
};

/// Some texels of a tile: columns left … right−1 and rows top … bottom−1, counted from the tile's first.
struct TilePart {
  const FootprintTile& tile;
  int left, top, right, bottom;

  TilePart(const FootprintTile& whole, const Canvas& canvas)
      : tile(whole),
        left(std::max(0, canvas.x - whole.x)),
        top(std::max(0, canvas.y - whole.y)),
        right(std::min(whole.width, canvas.x + canvas.texels.width - whole.x)),
        bottom(std::min(whole.height, canvas.y + canvas.texels.height - whole.y)) {}
  bool empty() const { return left >= right || top >= bottom; }
  int width() const { return right - left; }
  int height() const { return bottom - top; }
};

class AreaMaker final : public TexelMaker {
 public:
  explicit AreaMaker(ResampleJob whole)
      : job_(std::move(whole)), area_mean_(area_mean(job_.source.channels())) {
    // Plan: what each tile covers decides how many samples it needs and of which level.
    const MapFrame& target = job_.target;
    bands_ = (target.size.height + kTileSide - 1) / kTileSide;
    const int charts = target.parameterization.charts();
    tiles_.resize(static_cast<std::size_t>(charts * bands_));
    parallel_for(
        charts * bands_,
        [&](int i) {
          const int y = i % bands_ * kTileSide;
          plan_tiles(job_.source, target, job_.to_source, i / bands_, y,
                     std::min(kTileSide, target.size.height - y), tiles_[static_cast<std::size_t>(i)]);
        },
        without_progress(job_.options.monitor));
    int coarsest = 0;
    for (const auto& band : tiles_) {
      for (const auto& tile : band) coarsest = std::max(coarsest, tile.level);
    }
    pyramid_ = make_pyramid(job_.source, coarsest);
    levels_ = {view_of(job_.source.level)};
    for (const Level& level : pyramid_) levels_.push_back(view_of(level));
  }

  int rows() const override { return kTileSide; }

  void make(const ChartPart& part, ImageView<float> out) const override {
    // Tiles are the chart's, so they are made as it lies.
    if (part.walk.as_it_is()) return make(part.chart, {out, part.walk.start_x, part.walk.start_y});
    const auto [x, y, width, height] = texels_of(part.walk, out.width, out.height);
    Image image(width, height, out.channels, PixelContents::unset);
    make(part.chart, {image.view(), x, y});
    TexelWalk walk = part.walk;
    walk.start_x -= x;
    walk.start_y -= y;
    copy_walked(image.view(), walk, out);
  }

 private:
  void make(int chart, const Canvas& canvas) const {
    Batch batch(job_);
    for (int y = canvas.y / kTileSide * kTileSide; y < canvas.y + canvas.texels.height; y += kTileSide) {
      for (const FootprintTile& tile : tiles_[static_cast<std::size_t>(chart * bands_ + y / kTileSide)]) {
        if (const TilePart part(tile, canvas); !part.empty()) fill(part, canvas, batch);
      }
    }
  }

  void fill(const TilePart& part, const Canvas& canvas, Batch& batch) const {
    const FootprintTile& tile = part.tile;
    const int per_texel = tile.samples_right * tile.samples_down;
    if (per_texel == 1) {
      const int rows = std::max(1, kBatch / part.width());
      for (int y = part.top; y < part.bottom; y += rows)
        look_up(tile, part.left, y, part.width(), std::min(rows, part.bottom - y), canvas, batch);
      return;
    }
    // The texels of a small target are too large to be flat in the source, though they may look so at their
    // corners.
    constexpr int kSmall = 16;
    if (tile.whole && job_.target.size.width > kSmall && job_.target.size.height > kSmall)
      return fill_by_areas(part, canvas, batch);
    for (int y = part.top; y < part.bottom; ++y) {
      for (int x = part.left; x < part.right;)
        x += average(tile, x, y, part.right - x, per_texel, canvas, batch);
    }
  }

  /// Texels of a tile by one look-up each.
  void look_up(const FootprintTile& tile, int x, int y, int width, int height, const Canvas& canvas,
               Batch& batch) const {
    TexelWalk walk;
    walk.start_x = tile.x + x;
    walk.start_y = tile.y + y;
    resample_rectangle(job_, job_.fetch_of(Filter::automatic), {tile.chart, walk},
                       canvas.part(tile.x + x, tile.y + y, width, height), batch);
  }

  /// The points of columns × rows at such an offset from the first texel of a part.
  void locate_grid(const TilePart& part, int columns, int rows, float offset, Batch& batch,
                   Grid& grid) const {
    const FootprintTile& tile = part.tile;
    const std::size_t points = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
    for (auto* list : {&grid.chart, &grid.u, &grid.v, &grid.weight}) list->resize(points);
    const float across = 1.0f / static_cast<float>(job_.target.size.width);
    const float down = 1.0f / static_cast<float>(job_.target.size.height);
    for (std::size_t from = 0; from < points; from += kBatch) {
      const std::size_t count = std::min<std::size_t>(kBatch, points - from);
      for (std::size_t i = 0; i < count; ++i) {
        const int k = static_cast<int>(from + i);
        batch.u[i] = (static_cast<float>(tile.x + part.left + k % columns) + offset) * across;
        batch.v[i] = (static_cast<float>(tile.y + part.top + k / columns) + offset) * down;
      }
      batch.locate(tile.chart, count);
      batch.weigh(tile.chart, count);
      if (!job_.source_is_whole) {
        const float* covered = batch.covered(count);
        for (std::size_t i = 0; i < count; ++i) batch.weight[i] *= covered[i];
      }
      std::copy_n(batch.chart, count, grid.chart.data() + from);
      std::copy_n(batch.source_u, count, grid.u.data() + from);
      std::copy_n(batch.source_v, count, grid.v.data() + from);
      std::copy_n(batch.weight, count, grid.weight.data() + from);
    }
  }

  /// Texels whose area is a parallelogram in one source chart are averaged texel by texel; the few others
  /// (poles, chart edges, folds, rims) from samples whose positions are computed one by one.
  void fill_by_areas(const TilePart& part, const Canvas& canvas, Batch& batch) const {
    const FootprintTile& tile = part.tile;
    const int width = part.width(), height = part.height();
    Grid corners, centres;
    locate_grid(part, width + 1, height + 1, 0.0f, batch, corners);
    locate_grid(part, width, height, 0.5f, batch, centres);
    const LevelView& level = levels_[std::min(static_cast<std::size_t>(tile.level), levels_.size() - 1)];
    const int per_texel = tile.samples_right * tile.samples_down;
    std::vector<float> mean(job_.channels() + 8);
    Parallelogram area;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const std::size_t corner = static_cast<std::size_t>(y * (width + 1) + x);
        const std::size_t centre = static_cast<std::size_t>(y * width + x);
        if (parallelogram(level, corners, corner, static_cast<std::size_t>(width + 1), centres, centre,
                          area)) {
          area_mean_(level, &area, mean.data(), 1);
          std::copy_n(mean.data(), job_.channels(), canvas.at(tile.x + part.left + x, tile.y + part.top + y));
        } else {
          average(tile, part.left + x, part.top + y, 1, per_texel, canvas, batch);
        }
      }
    }
  }

  /// The parallelogram through four corners, unless one of them is not valid in either map, or they lie in
  /// different charts, or it bends or twists by more than a fraction of a texel, or the target's density is
  /// not linear over it, or it leaves the chart's border.
  static bool parallelogram(const LevelView& level, const Grid& corners, std::size_t corner, std::size_t row,
                            const Grid& centres, std::size_t centre, Parallelogram& out) {
    constexpr float kMaxBend = 0.25f, kMaxUnevenness = 0.005f;
    const std::size_t at[4] = {corner, corner + 1, corner + row, corner + row + 1};
    const float chart = centres.chart[centre];
    float x[4], y[4];
    for (int i = 0; i < 4; ++i) {
      if (corners.chart[at[i]] != chart || !(corners.weight[at[i]] > 0)) return false;
      x[i] = corners.u[at[i]] * static_cast<float>(level.width);
      y[i] = corners.v[at[i]] * static_cast<float>(level.height);
    }
    out.chart = static_cast<int>(chart);
    out.x = centres.u[centre] * static_cast<float>(level.width);
    out.y = centres.v[centre] * static_cast<float>(level.height);
    const auto middle = [](const float* p) { return 0.25f * (p[0] + p[1] + p[2] + p[3]); };
    const auto twist = [](const float* p) { return 0.25f * (p[0] + p[3] - p[1] - p[2]); };
    for (const float bend : {middle(x) - out.x, middle(y) - out.y, twist(x), twist(y)}) {
      if (!(std::fabs(bend) < kMaxBend)) return false;
    }
    const float right[2] = {0.5f * (x[1] + x[3] - x[0] - x[2]), 0.5f * (y[1] + y[3] - y[0] - y[2])};
    const float down[2] = {0.5f * (x[2] + x[3] - x[0] - x[1]), 0.5f * (y[2] + y[3] - y[0] - y[1])};
    const float extent_x = 0.5f * (std::fabs(right[0]) + std::fabs(down[0])) + 2;
    const float extent_y = 0.5f * (std::fabs(right[1]) + std::fabs(down[1])) + 2;
    const auto inside = [](float middle, float extent, int size) {
      return middle - extent >= -kBorder && middle + extent <= static_cast<float>(size + kBorder) &&
             extent < 0.25f * static_cast<float>(size) + 2;
    };
    if (!inside(out.x, extent_x, level.width) || !inside(out.y, extent_y, level.height)) return false;
    const float determinant = right[0] * down[1] - right[1] * down[0];
    if (!(std::fabs(determinant) > 0.5f)) return false;
    out.across[0] = down[1] / determinant;
    out.across[1] = -down[0] / determinant;
    out.down[0] = -right[1] / determinant;
    out.down[1] = right[0] / determinant;
    const float w[4] = {corners.weight[at[0]], corners.weight[at[1]], corners.weight[at[2]],
                        corners.weight[at[3]]};
    if (!(std::fabs(middle(w) - centres.weight[centre]) < kMaxUnevenness * centres.weight[centre]))
      return false;
    const float scale = 0.5f / centres.weight[centre];
    out.gradient[0] = (w[1] + w[3] - w[0] - w[2]) * scale;
    out.gradient[1] = (w[2] + w[3] - w[0] - w[1]) * scale;
    return std::isfinite(out.gradient[0]) && std::isfinite(out.gradient[1]);
  }

  /// Means of the next texels of a tile's row, at most `limit` and as many as fit into a batch; returns how
  /// many.
  int average(const FootprintTile& tile, int x0, int y0, int limit, int per_texel, const Canvas& canvas,
              Batch& batch) const {
    const int texels = std::clamp(kBatch / per_texel, 1, limit);
    // The more samples a mean has, the less their interpolation matters.
    const Fetch kernel = per_texel >= 9  ? job_.kernels.bilinear
                         : per_texel > 4 ? job_.fetch_of(Filter::bicubic)
                                         : job_.fetch_of(Filter::automatic);
    const LevelView& level = levels_[std::min(static_cast<std::size_t>(tile.level), levels_.size() - 1)];
    Sum sum(job_);
    std::vector<int> beyond;  // texels that are not valid, but show a part of the target
    for (int from = 0; from < per_texel; from += kBatch) {
      const int each = std::min(per_texel - from, kBatch);
      const std::size_t count = static_cast<std::size_t>(each) * static_cast<std::size_t>(texels);
      for (int texel = 0; texel < texels; ++texel) {
        spread_samples(tile, x0 + texel, y0, from, each, batch, static_cast<std::size_t>(texel * each));
      }
      batch.locate(tile.chart, count);
      batch.weigh(tile.chart, count);
      const float* values = batch.fetch(kernel, level, count);
      for (int texel = 0; texel < texels; ++texel) {
        if (from == 0) sum.clear();
        sum.add(batch.weight + texel * each,
                values + static_cast<std::size_t>(texel * each) * job_.channels(), each);
        if (from + each == per_texel && sum.empty() && job_.target.parameterization.filled_to_edges()) {
          beyond.push_back(x0 + texel);
        } else if (from + each == per_texel) {
          sum.mean(canvas.at(tile.x + x0 + texel, tile.y + y0));
        }
      }
    }
    for (const int x : beyond) look_up(tile, x, y0, 1, 1, canvas, batch);
    return texels;
  }

  /// Positions of samples from … from+count−1 of a texel, on a regular grid over the part of the texel that
  /// is averaged.
  void spread_samples(const FootprintTile& tile, int x, int y, int from, int count, Batch& batch,
                      std::size_t to) const {
    const float fx = (static_cast<float>(x) + 0.5f) / static_cast<float>(tile.width);
    const float fy = (static_cast<float>(y) + 0.5f) / static_cast<float>(tile.height);
    const auto mix = [&](const float* corners) {
      const float top = corners[0] + fx * (corners[1] - corners[0]);
      const float bottom = corners[2] + fx * (corners[3] - corners[2]);
      return top + fy * (bottom - top);
    };
    const float across = 1.0f / static_cast<float>(job_.target.size.width),
                down = 1.0f / static_cast<float>(job_.target.size.height);
    const float step_x = averaged_fraction(mix(tile.texels_right)) / static_cast<float>(tile.samples_right);
    const float step_y = averaged_fraction(mix(tile.texels_down)) / static_cast<float>(tile.samples_down);
    const float centre_x = static_cast<float>(tile.x + x) + 0.5f,
                centre_y = static_cast<float>(tile.y + y) + 0.5f;
    const float middle_x = 0.5f * static_cast<float>(tile.samples_right - 1);
    const float middle_y = 0.5f * static_cast<float>(tile.samples_down - 1);
    int column = from % tile.samples_right, row = from / tile.samples_right;
    for (int i = 0; i < count; ++i) {
      batch.u[to] = (centre_x + (static_cast<float>(column) - middle_x) * step_x) * across;
      batch.v[to] = (centre_y + (static_cast<float>(row) - middle_y) * step_y) * down;
      ++to;
      if (++column == tile.samples_right) {
        column = 0;
        ++row;
      }
    }
  }

  /// A weighted sum of samples: in float over a batch, in double over several.
  class Sum {
   public:
    explicit Sum(const ResampleJob& job) : job_(job), values_(job.channels()) {}

    bool empty() const { return !(total_ > 0); }

    void clear() {
      std::fill(values_.begin(), values_.end(), 0.0);
      total_ = 0;
    }

    void add(const float* weights, const float* values, int count) {
      const std::size_t n = values_.size();
      if (n == 3) {
        float r = 0, g = 0, b = 0, w = 0;
        for (int i = 0; i < count; ++i, values += 3) {
          w += weights[i];
          r += weights[i] * values[0];
          g += weights[i] * values[1];
          b += weights[i] * values[2];
        }
        values_[0] += static_cast<double>(r);
        values_[1] += static_cast<double>(g);
        values_[2] += static_cast<double>(b);
        total_ += static_cast<double>(w);
        return;
      }
      for (int i = 0; i < count; ++i, values += n) {
        const double weight = static_cast<double>(weights[i]);
        total_ += weight;
        for (std::size_t c = 0; c < n; ++c) values_[c] += weight * static_cast<double>(values[c]);
      }
    }

    /// The fill, where nothing had any weight.
    void mean(float* out) const {
      for (std::size_t c = 0; c < values_.size(); ++c) {
        out[c] = total_ > 0 ? static_cast<float>(values_[c] / total_) : job_.fill[c];
      }
    }

   private:
    const ResampleJob& job_;
    std::vector<double> values_;
    double total_ = 0;
  };

  const ResampleJob job_;
  const AreaMean area_mean_;
  int bands_ = 0;                                  ///< of a chart
  std::vector<std::vector<FootprintTile>> tiles_;  ///< of each band of each chart
  std::vector<Level> pyramid_;
  std::vector<LevelView> levels_;
};

}  // namespace

std::unique_ptr<TexelMaker> make_by_areas(ResampleJob job) {
  return std::make_unique<AreaMaker>(std::move(job));
}

}  // namespace welkin
