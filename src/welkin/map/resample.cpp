#include "welkin/map/resample.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstring>

#include "welkin/map/area.h"
#include "welkin/map/fetch.h"
#include "welkin/map/footprint.h"
#include "welkin/map/pyramid.h"

namespace welkin {
namespace {

constexpr std::array<std::pair<std::string_view, Filter>, 5> kFilterNames{{{"auto", Filter::automatic},
                                                                           {"nearest", Filter::nearest},
                                                                           {"bilinear", Filter::bilinear},
                                                                           {"bicubic", Filter::bicubic},
                                                                           {"lanczos", Filter::lanczos}}};

/// Samples that go through the pipeline together: their arrays stay in the first-level cache.
constexpr int kBatch = 256;

/// directions → rotate → places, for a batch of samples given as (u, v) of a target chart.
class Batch {
 public:
  alignas(64) float u[kBatch], v[kBatch];
  alignas(64) float chart[kBatch], source_u[kBatch], source_v[kBatch];
  alignas(64) float covered[kBatch], valid[kBatch], weight[kBatch];

  void locate(const Map& source, const Map& target, const Matrix3& to_source, bool turned, int target_chart,
              std::size_t count) {
    const auto& t = target.parameterization;
    const auto& s = source.parameterization;
    // Samples that fill up the last pack repeat a real one.
    for (std::size_t i = count; i < sphere::padded(count); ++i) {
      u[i] = u[count - 1];
      v[i] = v[count - 1];
    }
    t.kernels().to_sphere(t.self(), target_chart, u, v, x_, y_, z_, count);
    if (turned) rotate(to_source, sphere::padded(count));
    s.kernels().from_sphere(s.self(), x_, y_, z_, chart, source_u, source_v, count);
  }

  void find_covered(const Map& source, std::size_t count) {
    const auto& s = source.parameterization;
    s.kernels().covers(s.self(), x_, y_, z_, covered, count);
  }

 private:
  alignas(64) float x_[kBatch], y_[kBatch], z_[kBatch];

  void rotate(const Matrix3& m, std::size_t count) {
    float f[3][3];
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) f[i][j] = static_cast<float>(m.rows[i][j]);
    }
    for (std::size_t i = 0; i < count; ++i) {
      const float x = x_[i], y = y_[i], z = z_[i];
      x_[i] = f[0][0] * x + f[0][1] * y + f[0][2] * z;
      y_[i] = f[1][0] * x + f[1][1] * y + f[1][2] * z;
      z_[i] = f[2][0] * x + f[2][1] * y + f[2][2] * z;
    }
  }
};

class Resampler {
 public:
  Resampler(const Map& source, Map& target, const ResampleOptions& options)
      : source_(source),
        target_(target),
        options_(options),
        to_source_(source.orientation * transpose(options.rotation) * transpose(target.orientation)),
        turned_(!(to_source_ == Matrix3{})),
        target_is_full_(target.parameterization.full_charts()),
        source_is_whole_(source.parameterization.whole_world()),
        kernels_(fetch_kernels(source.channels())),
        area_mean_(area_mean(source.channels())),
        fill_(options.fill) {
    assert(source.channels() == target.channels());
    fill_.resize(static_cast<std::size_t>(source.channels()), 0.0f);
    levels_.push_back(view_of(source.level));
  }

  void run() {
    if (options_.filter == Filter::automatic) {
      run_automatic();
    } else {
      run_points(fetch_of(options_.filter));
    }
  }

 private:
  Fetch fetch_of(Filter filter) const {
    const auto choose = [&](const RingingFetch& kernel) {
      return options_.allow_ringing ? kernel.plain : kernel.held;
    };
    switch (filter) {
      case Filter::nearest: return kernels_.nearest;
      case Filter::bilinear: return kernels_.bilinear;
      case Filter::bicubic: return choose(kernels_.bicubic);
      case Filter::lanczos: return choose(kernels_.lanczos3);
      case Filter::automatic: break;
    }
    return choose(kernels_.lanczos4);
  }

  std::size_t channels() const { return static_cast<std::size_t>(source_.channels()); }

  /// One look-up per texel, in tiles that are read along and across.
  void run_points(Fetch fetch) {
    constexpr int kRows = 8;
    const int bands = (target_.height() + kRows - 1) / kRows;
    parallel_for(
        target_.charts() * bands,
        [&](int i) {
          const int y = i % bands * kRows;
          std::vector<float> pixels(kBatch * channels() + 8);
          Batch batch;
          for (int x = 0; x < target_.width(); x += kBatch / kRows) {
            look_up(fetch, i / bands, x, y, std::min(kBatch / kRows, target_.width() - x),
                    std::min(kRows, target_.height() - y), batch, pixels);
          }
        },
        options_.monitor);
  }

  /// A rectangle of at most kBatch texels, one look-up each.
  void look_up(Fetch fetch, int chart, int x0, int y0, int width, int height, Batch& batch,
               std::vector<float>& pixels) {
    const float across = 1.0f / static_cast<float>(target_.width()), down = 1.0f / static_cast<float>(target_.height());
    std::size_t count = 0;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x, ++count) {
        batch.u[count] = (static_cast<float>(x0 + x) + 0.5f) * across;
        batch.v[count] = (static_cast<float>(y0 + y) + 0.5f) * down;
      }
    }
    batch.locate(source_, target_, to_source_, turned_, chart, count);
    fetch(levels_[0], batch.chart, batch.source_u, batch.source_v, pixels.data(), count);
    if (!source_is_whole_) {
      batch.find_covered(source_, count);
      fill_where_zero(batch.covered, count, pixels);
    }
    if (!target_is_full_) {
      const auto& t = target_.parameterization;
      t.kernels().valid(t.self(), chart, batch.u, batch.v, batch.valid, count);
      fill_where_zero(batch.valid, count, pixels);
    }
    store(chart, x0, y0, width, height, pixels.data());
  }

  void fill_where_zero(const float* mask, std::size_t count, std::vector<float>& pixels) const {
    for (std::size_t i = 0; i < count; ++i) {
      if (!(mask[i] > 0)) std::copy(fill_.begin(), fill_.end(), pixels.data() + i * channels());
    }
  }

  void store(int chart, int x0, int y0, int width, int height, const float* pixels) {
    const ImageView<float> out = target_.level.chart(chart);
    const std::size_t row = static_cast<std::size_t>(width) * channels();
    for (int y = 0; y < height; ++y) {
      std::memcpy(out.at(x0, y0 + y), pixels + static_cast<std::size_t>(y) * row, row * sizeof(float));
    }
  }

  void run_automatic() {
    // Plan: what each tile covers decides how many samples it needs and of which level.
    const int bands = (target_.height() + kTileSide - 1) / kTileSide;
    std::vector<std::vector<FootprintTile>> tiles(static_cast<std::size_t>(target_.charts() * bands));
    parallel_for(target_.charts() * bands, [&](int i) {
      const int y = i % bands * kTileSide;
      plan_tiles(source_, target_, to_source_, i / bands, y, std::min(kTileSide, target_.height() - y),
                 tiles[static_cast<std::size_t>(i)]);
    });
    int coarsest = 0;
    for (const auto& band : tiles) {
      for (const auto& tile : band) coarsest = std::max(coarsest, tile.level);
    }
    pyramid_ = make_pyramid(source_, coarsest);
    for (const Level& level : pyramid_) levels_.push_back(view_of(level));
    parallel_for(
        static_cast<int>(tiles.size()),
        [&](int i) {
          std::vector<float> pixels(kBatch * channels() + 8);
          Batch batch;
          for (const FootprintTile& tile : tiles[static_cast<std::size_t>(i)]) sample(tile, batch, pixels);
        },
        options_.monitor);
  }

  void sample(const FootprintTile& tile, Batch& batch, std::vector<float>& pixels) {
    const int per_texel = tile.samples_right * tile.samples_down;
    if (per_texel == 1) {
      const int rows = std::max(1, kBatch / tile.width);
      for (int y = 0; y < tile.height; y += rows) {
        look_up(fetch_of(Filter::automatic), tile.chart, tile.x, tile.y + y, tile.width,
                std::min(rows, tile.height - y), batch, pixels);
      }
      return;
    }
    if (tile.whole && source_is_whole_ && target_is_full_) return average_areas(tile, batch, pixels);
    for (int y = 0; y < tile.height; ++y) {
      for (int x = 0; x < tile.width;) x += average(tile, x, y, tile.width, per_texel, batch, pixels);
    }
  }

  /// Where a grid of points of the target lies in the source: (columns+1) × (rows+1) corners, or columns × rows centres.
  struct Grid {
    std::vector<float> chart, u, v, weight;
  };

  void locate_grid(const FootprintTile& tile, int columns, int rows, float offset, Batch& batch, Grid& grid) {
    const std::size_t points = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
    for (auto* list : {&grid.chart, &grid.u, &grid.v, &grid.weight}) list->resize(points);
    const float across = 1.0f / static_cast<float>(target_.width()), down = 1.0f / static_cast<float>(target_.height());
    for (std::size_t from = 0; from < points; from += kBatch) {
      const std::size_t count = std::min<std::size_t>(kBatch, points - from);
      for (std::size_t i = 0; i < count; ++i) {
        const int k = static_cast<int>(from + i);
        batch.u[i] = (static_cast<float>(tile.x + k % columns) + offset) * across;
        batch.v[i] = (static_cast<float>(tile.y + k / columns) + offset) * down;
      }
      weigh(tile.chart, batch, count);
      std::copy_n(batch.chart, count, grid.chart.data() + from);
      std::copy_n(batch.source_u, count, grid.u.data() + from);
      std::copy_n(batch.source_v, count, grid.v.data() + from);
      std::copy_n(batch.weight, count, grid.weight.data() + from);
    }
  }

  /// Texels whose area is a parallelogram in one source chart are averaged texel by texel; the few others (poles, chart edges,
  /// folds) from samples that each find their own place.
  void average_areas(const FootprintTile& tile, Batch& batch, std::vector<float>& pixels) {
    Grid corners, centres;
    locate_grid(tile, tile.width + 1, tile.height + 1, 0.0f, batch, corners);
    locate_grid(tile, tile.width, tile.height, 0.5f, batch, centres);
    const std::size_t level = std::min(static_cast<std::size_t>(tile.level), levels_.size() - 1);
    const int per_texel = tile.samples_right * tile.samples_down;
    std::vector<Parallelogram> areas(1);
    for (int y = 0; y < tile.height; ++y) {
      for (int x = 0; x < tile.width; ++x) {
        const std::size_t corner = static_cast<std::size_t>(y * (tile.width + 1) + x);
        const std::size_t centre = static_cast<std::size_t>(y * tile.width + x);
        if (parallelogram(levels_[level], corners, corner, static_cast<std::size_t>(tile.width + 1), centres, centre,
                          areas[0])) {
          area_mean_(levels_[level], areas.data(), pixels.data(), 1);
          std::copy_n(pixels.data(), channels(), target_.level.chart(tile.chart).at(tile.x + x, tile.y + y));
        } else {
          average(tile, x, y, 1, per_texel, batch, pixels);
        }
      }
    }
  }

  /// The parallelogram through four corners, unless they lie in different charts, or it bends or twists by more than a
  /// fraction of a texel, or the target's density is not linear over it, or it leaves the chart's border.
  static bool parallelogram(const LevelView& level, const Grid& corners, std::size_t corner, std::size_t row,
                            const Grid& centres, std::size_t centre, Parallelogram& out) {
    constexpr float kMostBend = 0.25f, kMostUnevenness = 0.005f;
    const std::size_t at[4] = {corner, corner + 1, corner + row, corner + row + 1};
    const float chart = centres.chart[centre];
    float x[4], y[4];
    for (int i = 0; i < 4; ++i) {
      if (corners.chart[at[i]] != chart) return false;
      x[i] = corners.u[at[i]] * static_cast<float>(level.width);
      y[i] = corners.v[at[i]] * static_cast<float>(level.height);
    }
    out.chart = static_cast<int>(chart);
    out.x = centres.u[centre] * static_cast<float>(level.width);
    out.y = centres.v[centre] * static_cast<float>(level.height);
    const auto middle = [](const float* p) { return 0.25f * (p[0] + p[1] + p[2] + p[3]); };
    const auto twist = [](const float* p) { return 0.25f * (p[0] + p[3] - p[1] - p[2]); };
    for (const float bend : {middle(x) - out.x, middle(y) - out.y, twist(x), twist(y)}) {
      if (!(std::fabs(bend) < kMostBend)) return false;
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
    const float w[4] = {corners.weight[at[0]], corners.weight[at[1]], corners.weight[at[2]], corners.weight[at[3]]};
    if (!(std::fabs(middle(w) - centres.weight[centre]) < kMostUnevenness * centres.weight[centre])) return false;
    const float scale = 0.5f / centres.weight[centre];
    out.gradient[0] = (w[1] + w[3] - w[0] - w[2]) * scale;
    out.gradient[1] = (w[2] + w[3] - w[0] - w[1]) * scale;
    return std::isfinite(out.gradient[0]) && std::isfinite(out.gradient[1]);
  }

  /// Means of the next texels of a tile's row, at most `most` and as many as fit into a batch; returns how many.
  int average(const FootprintTile& tile, int x0, int y0, int most, int per_texel, Batch& batch, std::vector<float>& pixels) {
    const int texels = std::clamp(kBatch / per_texel, 1, std::min(most, tile.width - x0));
    const Fetch fetch = tile.samples_right >= 3 && tile.samples_down >= 3 ? kernels_.bilinear
                                                                          : fetch_of(Filter::automatic);
    const std::size_t level = std::min(static_cast<std::size_t>(tile.level), levels_.size() - 1);
    std::array<double, 64> sums{};
    double total = 0;
    for (int from = 0; from < per_texel; from += kBatch) {
      const int each = std::min(per_texel - from, kBatch);
      const std::size_t count = static_cast<std::size_t>(each) * static_cast<std::size_t>(texels);
      for (int texel = 0; texel < texels; ++texel) {
        spread_samples(tile, x0 + texel, y0, from, each, batch, static_cast<std::size_t>(texel * each));
      }
      weigh(tile.chart, batch, count);
      fetch(levels_[level], batch.chart, batch.source_u, batch.source_v, pixels.data(), count);
      if (!source_is_whole_) {
        batch.find_covered(source_, count);
        fill_where_zero(batch.covered, count, pixels);
      }
      for (int texel = 0; texel < texels; ++texel) {
        if (from == 0) {
          sums.fill(0);
          total = 0;
        }
        add_up(batch.weight + texel * each, pixels.data() + static_cast<std::size_t>(texel * each) * channels(), each, sums,
               total);
        if (from + each == per_texel) finish(tile.chart, tile.x + x0 + texel, tile.y + y0, sums, total);
      }
    }
    return texels;
  }

  /// Places of samples from … from+count−1 of a texel, on a regular grid over the part of the texel that is averaged.
  void spread_samples(const FootprintTile& tile, int x, int y, int from, int count, Batch& batch,
                      std::size_t to) const {
    const float fx = (static_cast<float>(x) + 0.5f) / static_cast<float>(tile.width);
    const float fy = (static_cast<float>(y) + 0.5f) / static_cast<float>(tile.height);
    const auto mix = [&](const float* corners) {
      const float top = corners[0] + fx * (corners[1] - corners[0]);
      const float bottom = corners[2] + fx * (corners[3] - corners[2]);
      return top + fy * (bottom - top);
    };
    const float across = 1.0f / static_cast<float>(target_.width()), down = 1.0f / static_cast<float>(target_.height());
    const float step_x = spread(mix(tile.texels_right)) / static_cast<float>(tile.samples_right);
    const float step_y = spread(mix(tile.texels_down)) / static_cast<float>(tile.samples_down);
    const float centre_x = static_cast<float>(tile.x + x) + 0.5f, centre_y = static_cast<float>(tile.y + y) + 0.5f;
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

  /// Each sample weighs as much as the solid angle around it, and nothing outside the target's places.
  void weigh(int chart, Batch& batch, std::size_t count) {
    batch.locate(source_, target_, to_source_, turned_, chart, count);
    const auto& t = target_.parameterization;
    t.kernels().density(t.self(), chart, batch.u, batch.v, batch.weight, count);
    // At a pole the density rounds to either side of zero.
    for (std::size_t i = 0; i < count; ++i) batch.weight[i] = std::max(batch.weight[i], 0.0f);
    if (target_is_full_) return;
    t.kernels().valid(t.self(), chart, batch.u, batch.v, batch.valid, count);
    for (std::size_t i = 0; i < count; ++i) batch.weight[i] = batch.valid[i] > 0 ? batch.weight[i] : 0.0f;
  }

  void add_up(const float* weights, const float* values, int count, std::array<double, 64>& sums, double& total) const {
    const std::size_t n = channels();
    if (n == 3) {
      float r = 0, g = 0, b = 0, w = 0;
      for (int i = 0; i < count; ++i, values += 3) {
        const float weight = weights[i];
        w += weight;
        r += weight * values[0];
        g += weight * values[1];
        b += weight * values[2];
      }
      sums[0] += static_cast<double>(r);
      sums[1] += static_cast<double>(g);
      sums[2] += static_cast<double>(b);
      total += static_cast<double>(w);
      return;
    }
    for (int i = 0; i < count; ++i, values += n) {
      const double weight = static_cast<double>(weights[i]);
      total += weight;
      for (std::size_t c = 0; c < n; ++c) sums[c] += weight * static_cast<double>(values[c]);
    }
  }

  void finish(int chart, int x, int y, const std::array<double, 64>& sums, double total) {
    float* out = target_.level.chart(chart).at(x, y);
    for (std::size_t c = 0; c < channels(); ++c) {
      out[c] = total > 0 ? static_cast<float>(sums[c] / total) : fill_[c];
    }
  }

  const Map& source_;
  Map& target_;
  const ResampleOptions& options_;
  const Matrix3 to_source_;
  const bool turned_;
  const bool target_is_full_;
  const bool source_is_whole_;
  const FetchKernels kernels_;
  const AreaMean area_mean_;
  std::vector<float> fill_;
  std::vector<Level> pyramid_;
  std::vector<LevelView> levels_;
};

}  // namespace

Filter filter_from_name(std::string_view name) {
  std::vector<std::string> names;
  for (const auto& [each, filter] : kFilterNames) {
    if (each == name) return filter;
    names.emplace_back(each);
  }
  throw Error(unknown_name("filter", name, names));
}

std::string_view name_of(Filter filter) {
  for (const auto& [name, each] : kFilterNames) {
    if (each == filter) return name;
  }
  return "?";
}

void resample(const Map& source, Map& target, const ResampleOptions& options) {
  const bool same = source.parameterization == target.parameterization && source.width() == target.width() &&
                    source.height() == target.height() &&
                    source.orientation * transpose(options.rotation) == target.orientation;
  if (same) {
    for (int chart = 0; chart < source.charts(); ++chart) {
      copy_pixels(source.level.chart(chart), target.level.chart(chart));
    }
    return;
  }
  Resampler(source, target, options).run();
}

ChartSize default_chart_size(const Map& map, const sphere::AnyParameterization& parameterization) {
  // The part of its charts' area that is places of the map, on a grid fine enough for a few per mille.
  const auto used = [](const sphere::AnyParameterization& p) {
    constexpr int kGrid = 64;
    int valid = 0;
    for (int i = 0; i < kGrid * kGrid; ++i) {
      if (p.valid(0, (i % kGrid + 0.5) / kGrid, (i / kGrid + 0.5) / kGrid)) ++valid;
    }
    return static_cast<double>(valid) / (kGrid * kGrid) * p.charts();
  };
  const double per_steradian =
      used(map.parameterization) * map.width() * map.height() / map.parameterization.coverage();
  const double texels = per_steradian * parameterization.coverage() / used(parameterization);
  const int width = std::max(2, 2 * static_cast<int>(std::lround(0.5 * std::sqrt(texels * parameterization.aspect()))));
  return {width, std::max(1, static_cast<int>(std::lround(width / parameterization.aspect())))};
}

}  // namespace welkin
