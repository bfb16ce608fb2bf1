#include <algorithm>
#include <cmath>
#include <cstring>

#include "welkin/map/fetch.h"
#include "welkin/prefilter/bright_points.h"
#include "welkin/prefilter/kernels.h"
#include "welkin/prefilter/moments.h"
#include "welkin/prefilter/spline_grid.h"
#include "welkin/prefilter/tables.h"

namespace welkin {
namespace {

using namespace prefilter;
using Tables = PrefilterPlan::Tables;

constexpr std::size_t kBatch = 256;

/// Where the coefficients of order m begin, degrees m … degree one after the other.
std::size_t offset_of(int m, int degree) {
  const std::size_t n = static_cast<std::size_t>(m);
  return n * static_cast<std::size_t>(degree + 1) - n * (n - 1) / 2;
}

/// The pipeline for up to three channels from `first`.
class Harmonics {
 public:
  Harmonics(const Tables& tables, Moments& moments, int first, int channels, std::vector<Level>& grids)
      : t_(tables),
        moments_(moments),
        first_(first),
        channels_(channels),
        parts_(2 * channels),
        grids_(grids) {}

  void run(const Monitor& monitor) {
    transform_rows(monitor);
    analyse(monitor);
    synthesise(monitor);
    transform_back(monitor);
  }

 private:
  std::size_t order_size(const Latitudes& latitudes) const {
    return static_cast<std::size_t>(latitudes.packs) * 2 * static_cast<std::size_t>(parts_) * 8;
  }

  void transform_rows(const Monitor& monitor) {
    const Latitudes& latitudes = t_.moments_latitudes[0];
    orders_ = Buffer(order_size(latitudes) * static_cast<std::size_t>(t_.degree + 1));
    parallel_for(
        moments_.packs,
        [&](int pack) {
          Buffer work(static_cast<std::size_t>(moments_.width) * 16);
          for (int c = 0; c < channels_; ++c) {
            float* orders = orders_.data() + (static_cast<std::ptrdiff_t>(pack) * 2 * parts_ + 2 * c) * 8;
            kernels().rows_to_orders(t_.moments_fft[0], moments_.at(pack, first_ + c), work.data(),
                                     t_.order_factors.data(), t_.degree, moments_.packs, parts_, orders);
          }
        },
        monitor);
  }

  void analyse(const Monitor& monitor) {
    const Latitudes& latitudes = t_.moments_latitudes[0];
    coefficients_ = Buffer(offset_of(t_.degree + 1, t_.degree) * static_cast<std::size_t>(parts_));
    parallel_for(
        t_.degree + 1,
        [&](int m) {
          Buffer work(static_cast<std::size_t>((t_.degree + 2) * parts_ * 8));
          kernels().analyse[channels_ - 1](
              latitudes, t_.recurrences[static_cast<std::size_t>(m)], t_.degree,
              orders_.data() + order_size(latitudes) * static_cast<std::size_t>(m), work.data(),
              coefficients_.data() + offset_of(m, t_.degree) * static_cast<std::size_t>(parts_));
        },
        monitor);
  }

  void synthesise(const Monitor& monitor) {
    struct Item {
      std::size_t level;
      int m;
    };
    std::vector<Item> items;
    level_orders_.resize(t_.harmonic.size());
    for (std::size_t i = 0; i < t_.harmonic.size(); ++i) {
      const HarmonicLevel& level = t_.harmonic[i];
      level_orders_[i] = Buffer(order_size(level.latitudes) * static_cast<std::size_t>(level.degree + 1));
      for (int m = 0; m <= level.degree; ++m) items.push_back({i, m});
    }
    parallel_for(
        static_cast<int>(items.size()),
        [&](int k) {
          const auto [i, m] = items[static_cast<std::size_t>(k)];
          synthesise_order(
              t_.harmonic[i], m,
              level_orders_[i].data() + order_size(t_.harmonic[i].latitudes) * static_cast<std::size_t>(m));
        },
        monitor);
  }

  void synthesise_order(const HarmonicLevel& level, int m, float* orders) {
    const Recurrence& r = t_.recurrences[static_cast<std::size_t>(m)];
    const float* a = coefficients_.data() + offset_of(m, t_.degree) * static_cast<std::size_t>(parts_);
    const float cosine = level.turn[static_cast<std::size_t>(2 * m)];
    const float sine = level.turn[static_cast<std::size_t>(2 * m + 1)];
    std::vector<float> scaled(static_cast<std::size_t>((level.degree - m + 1) * parts_));
    float* to = scaled.data();
    for (int l = m; l <= level.degree; ++l, a += parts_, to += parts_) {
      const float factor = level.zonal[static_cast<std::size_t>(l)] *
                           static_cast<float>(r.scale[static_cast<std::size_t>(l - m)]);
      const float turn_re = factor * cosine, turn_im = factor * sine;
      for (int p = 0; p < parts_; p += 2) {
        to[p] = a[p] * turn_re - a[p + 1] * turn_im;
        to[p + 1] = a[p] * turn_im + a[p + 1] * turn_re;
      }
    }
    kernels().synthesise[channels_ - 1](level.latitudes, r, level.degree, scaled.data(), orders);
  }

  void transform_back(const Monitor& monitor) {
    struct Item {
      std::size_t level;
      int pack;
    };
    std::vector<Item> items;
    for (std::size_t i = 0; i < t_.harmonic.size(); ++i) {
      for (int pack = 0; pack < t_.harmonic[i].latitudes.packs; ++pack) items.push_back({i, pack});
    }
    parallel_for(
        static_cast<int>(items.size()),
        [&](int k) {
          const auto [i, pack] = items[static_cast<std::size_t>(k)];
          const HarmonicLevel& level = t_.harmonic[i];
          const std::size_t size = static_cast<std::size_t>(level.grid.width) * 16;
          Buffer memory(2 * size);
          for (int c = 0; c < channels_; ++c) {
            const float* orders =
                level_orders_[i].data() + (static_cast<std::ptrdiff_t>(pack) * 2 * parts_ + 2 * c) * 8;
            const float* rows =
                kernels().orders_to_rows(level.fft, orders, level.degree, level.latitudes.packs, parts_,
                                         memory.data(), memory.data() + size);
            store_rows(level, pack, c, rows, grids_[i]);
          }
        },
        monitor);
  }

  void store_rows(const HarmonicLevel& level, int pack, int c, const float* lanes, Level& grid) const {
    const ImageView<float> chart = grid.chart(0);
    for (int lane = 0; lane < 16; ++lane) {
      const int north = pack * 8 + lane % 8;
      if (north >= level.latitudes.count) continue;
      float* row = chart.row(lane < 8 ? north : level.grid.height - 1 - north) + first_ + c;
      for (int x = 0; x < level.grid.width; ++x) {
        row[static_cast<std::ptrdiff_t>(x) * chart.channels] =
            lanes[static_cast<std::ptrdiff_t>(x) * 16 + lane];
      }
    }
  }

  const Tables& t_;
  Moments& moments_;
  int first_, channels_, parts_;
  std::vector<Level>& grids_;
  Buffer orders_, coefficients_;
  std::vector<Buffer> level_orders_;
};

/// Level texels: the grid's spline, and the bright points' exact sums.
class Tiles {
 public:
  Tiles(const HarmonicLevel& level, const Level& grid, const BrightPoints& bright, const Matrix3& to_source,
        bool hold_positive, Map& result)
      : level_(level),
        view_(view_of(grid)),
        fetch_(fetch_kernels(grid.channels()).b_spline),
        bright_(bright),
        grid_shape_(sphere::AnyParameterization::make("latlong")),
        to_source_(to_source),
        hold_positive_(hold_positive),
        result_(result),
        masses_(bright.mass) {
    for (float& mass : masses_) mass *= static_cast<float>(level.scale);
  }

  void rows(int chart, int from, int rows) const {
    const int width = result_.width(), height = result_.height(), n = result_.channels();
    alignas(64) float u[kBatch], v[kBatch], x[kBatch], y[kBatch], z[kBatch];
    alignas(64) float at_chart[kBatch], at_u[kBatch], at_v[kBatch];
    std::vector<float> values(kBatch * static_cast<std::size_t>(n) + 8);
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
      turn(x, y, z, sphere::padded(count));
      grid_shape_.kernels().from_sphere(grid_shape_.self(), x, y, z, at_chart, at_u, at_v, count);
      fetch_(view_, at_chart, at_u, at_v, values.data(), count);
      add_bright(x, y, z, values.data(), count);
      if (hold_positive_) {
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

 private:
  void turn(float* x, float* y, float* z, std::size_t count) const {
    if (to_source_ == Matrix3{}) return;
    float f[3][3];
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) f[i][j] = static_cast<float>(to_source_.rows[i][j]);
    }
    for (std::size_t i = 0; i < count; ++i) {
      const float a = x[i], b = y[i], c = z[i];
      x[i] = f[0][0] * a + f[0][1] * b + f[0][2] * c;
      y[i] = f[1][0] * a + f[1][1] * b + f[1][2] * c;
      z[i] = f[2][0] * a + f[2][1] * b + f[2][2] * c;
    }
  }

  void add_bright(const float* x, const float* y, const float* z, float* values, std::size_t count) const {
    if (bright_.count() == 0) return;
    const lobe::Points points{bright_.x.data(), bright_.y.data(), bright_.z.data(),
                              masses_.data(),   bright_.count(),  bright_.channels};
    if (level_.sampled.empty()) {
      level_.lobe.point_sums()(level_.lobe.self(), points, x, y, z, values, count);
    } else {
      kernels().sampled_sums(&level_.sampled[0], points, x, y, z, values, count);
    }
  }

  const HarmonicLevel& level_;
  LevelView view_;
  Fetch fetch_;
  const BrightPoints& bright_;
  sphere::AnyParameterization grid_shape_;
  Matrix3 to_source_;
  bool hold_positive_;
  Map& result_;
  std::vector<float> masses_;  ///< the bright points', times the lobe's scale
};

}  // namespace

std::optional<Map> run_harmonics(const Tables& t, const Map& source, std::vector<Map>& results,
                                 const Monitor& monitor) {
  Moments moments = moments_of(source, t.moments[0], monitor);
  const BrightPoints bright = take_bright_points(moments, {}, monitor);

  std::vector<Level> grids;
  for (const HarmonicLevel& level : t.harmonic) {
    grids.emplace_back(1, level.grid.width, level.grid.height, source.channels());
  }
  for (int first = 0; first < source.channels(); first += 3) {
    Harmonics(t, moments, first, std::min(3, source.channels() - first), grids).run(monitor);
  }

  constexpr int kColumns = 64;
  struct Strip {
    std::size_t level;
    int first, last;
  };
  std::vector<Strip> strips;
  for (std::size_t i = 0; i < grids.size(); ++i) {
    const int half = grids[i].width() / 2;
    for (int x = 0; x < half; x += kColumns) strips.push_back({i, x, std::min(half, x + kColumns)});
  }
  parallel_for(
      static_cast<int>(strips.size()),
      [&](int k) {
        const Strip& strip = strips[static_cast<std::size_t>(k)];
        to_spline_columns(grids[strip.level], strip.first, strip.last);
      },
      monitor);
  for (Level& grid : grids) fill_latlong_border(grid);

  struct Band {
    std::size_t level;
    int chart, row, rows;
  };
  std::vector<Band> bands;
  for (std::size_t i = 0; i < t.harmonic.size(); ++i) {
    const Map& map = results[static_cast<std::size_t>(t.harmonic[i].index)];
    const int rows = std::max(1, 2048 / map.width());
    for (int chart = 0; chart < map.charts(); ++chart) {
      for (int y = 0; y < map.height(); y += rows)
        bands.push_back({i, chart, y, std::min(rows, map.height() - y)});
    }
  }
  parallel_for(
      static_cast<int>(bands.size()),
      [&](int k) {
        const Band& band = bands[static_cast<std::size_t>(k)];
        Map& result = results[static_cast<std::size_t>(t.harmonic[band.level].index)];
        const Matrix3 to_source = source.orientation * transpose(result.orientation);
        Tiles(t.harmonic[band.level], grids[band.level], bright, to_source, true, result)
            .rows(band.chart, band.row, band.rows);
      },
      monitor);
  return std::move(moments.reduced);
}

}  // namespace welkin
