#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <mutex>

#include "welkin/prefilter/bright_points.h"
#include "welkin/prefilter/kernels.h"
#include "welkin/prefilter/level_texels.h"
#include "welkin/prefilter/moments.h"
#include "welkin/prefilter/spline_grid.h"
#include "welkin/prefilter/tables.h"

namespace welkin {
namespace {

using namespace prefilter;
using Tables = PrefilterPlan::Tables;

/// Where the coefficients of order m begin, degrees m … degree one after the other.
std::size_t offset_of(int m, int degree) {
  const std::size_t n = static_cast<std::size_t>(m);
  return n * static_cast<std::size_t>(degree + 1) - n * (n - 1) / 2;
}

/// The pipeline for up to three channels from `first`.
class Harmonics {
 public:
  Harmonics(const Tables& tables, Moments& moments, const BrightPoints& bright, int first, int channels,
            std::vector<Level>& grids)
      : t_(tables),
        moments_(moments),
        bright_(bright),
        first_(first),
        channels_(channels),
        parts_(2 * channels),
        grids_(grids) {}

  void run(const Monitor& monitor) {
    transform_rows(part_of(monitor, 0, 0.1));
    analyse(part_of(monitor, 0.1, 0.4));
    if (std::any_of(t_.harmonic.begin(), t_.harmonic.end(), [](const auto& level) { return level.all; }))
      add_bright();
    synthesise(part_of(monitor, 0.4, 0.85));
    transform_back(part_of(monitor, 0.85, 1));
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

  /// What far parts of narrow lobes and smooth lobes need: the coefficients of all masses, the bright ones
  /// included.
  void add_bright() {
    const std::size_t size = offset_of(t_.degree + 1, t_.degree) * static_cast<std::size_t>(parts_);
    all_coefficients_ = Buffer(size);
    std::memcpy(all_coefficients_.data(), coefficients_.data(), size * sizeof(float));
    if (bright_.count() == 0) return;
    // A point is a row of its own, north or south of the equator.
    const std::size_t count = static_cast<std::size_t>(bright_.count());
    std::vector<double> cosines, angles;
    for (std::size_t i = 0; i < count; ++i) {
      cosines.push_back(std::fabs(static_cast<double>(bright_.y[i])));
      const double u =
          0.5 - std::atan2(static_cast<double>(bright_.x[i]), static_cast<double>(bright_.z[i])) / (2 * kPi);
      angles.push_back(2 * kPi * (u - 0.5 / moments_.width));
    }
    const Latitudes latitudes(cosines, t_.degree);
    parallel_for(t_.degree + 1, [&](int m) {
      std::vector<float> rows(order_size(latitudes), 0.0f);
      for (std::size_t i = 0; i < count; ++i) {
        const float re = static_cast<float>(std::cos(m * angles[i])),
                    im = static_cast<float>(-std::sin(m * angles[i]));
        const float side = bright_.y[i] < 0 ? -1.0f : 1.0f;
        float* even = rows.data() + i / 8 * 16 * static_cast<std::size_t>(parts_) + i % 8;
        float* odd = even + 8 * parts_;
        for (int c = 0; c < channels_; ++c) {
          const float mass = bright_.mass[i * static_cast<std::size_t>(bright_.channels) +
                                          static_cast<std::size_t>(first_ + c)];
          even[16 * c] = mass * re;
          even[16 * c + 8] = mass * im;
          odd[16 * c] = side * mass * re;
          odd[16 * c + 8] = side * mass * im;
        }
      }
      Buffer work(static_cast<std::size_t>((t_.degree + 2) * parts_ * 8));
      const std::size_t terms = static_cast<std::size_t>((t_.degree - m + 1) * parts_);
      std::vector<float> sums(terms);
      kernels().analyse[channels_ - 1](latitudes, t_.recurrences[static_cast<std::size_t>(m)], t_.degree,
                                       rows.data(), work.data(), sums.data());
      float* to = all_coefficients_.data() + offset_of(m, t_.degree) * static_cast<std::size_t>(parts_);
      for (std::size_t k = 0; k < terms; ++k) to[k] += sums[k];
    });
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
              t_.harmonic[i], t_.harmonic[i].all ? all_coefficients_ : coefficients_, m,
              level_orders_[i].data() + order_size(t_.harmonic[i].latitudes) * static_cast<std::size_t>(m));
        },
        monitor);
  }

  void synthesise_order(const HarmonicLevel& level, const Buffer& coefficients, int m, float* orders) {
    const Recurrence& r = t_.recurrences[static_cast<std::size_t>(m)];
    const float* a = coefficients.data() + offset_of(m, t_.degree) * static_cast<std::size_t>(parts_);
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
    std::array<float*, 16> rows{};
    for (int lane = 0; lane < 16; ++lane) {
      const int north = pack * 8 + lane % 8;
      if (north >= level.latitudes.count) continue;
      rows[static_cast<std::size_t>(lane)] =
          chart.row(lane < 8 ? north : level.grid.height - 1 - north) + first_ + c;
    }
    store_lanes(lanes, rows, grid);
  }

  const Tables& t_;
  Moments& moments_;
  const BrightPoints& bright_;
  int first_, channels_, parts_;
  std::vector<Level>& grids_;
  Buffer orders_, coefficients_, all_coefficients_;
  std::vector<Buffer> level_orders_;
};

/// One thread's work: a worker that waits for this must not be given other work meanwhile.
bool has_negative(const Map& map) {
  for (int chart = 0; chart < map.charts(); ++chart) {
    for (int y = 0; y < map.height(); ++y) {
      const float* row = map.level.chart(chart).row(y);
      int below = 0;
      for (int i = 0; i < map.width() * map.channels(); ++i) below += row[i] < 0 ? 1 : 0;
      if (below > 0) return true;
    }
  }
  return false;
}

}  // namespace

std::optional<Map> run_harmonics(const Tables& t, const Map& source, std::vector<Map>& results,
                                 const Monitor& monitor) {
  Moments moments = moments_of(source, t.moments[0], part_of(monitor, 0, 0.2));
  const BrightPoints bright = take_bright_points(moments, {}, part_of(monitor, 0.2, 0.22));

  std::vector<Level> grids;
  for (const HarmonicLevel& level : t.harmonic) {
    grids.emplace_back(1, level.grid.width, level.grid.height, source.channels(), PixelContents::unset);
  }
  for (int first = 0; first < source.channels(); first += 3) {
    const double share = 0.28 / source.channels(), from = 0.22 + first * share;
    const int channels = std::min(3, source.channels() - first);
    Harmonics(t, moments, bright, first, channels, grids)
        .run(part_of(monitor, from, from + channels * share));
  }

  std::vector<std::vector<Level>> near_grids;
  std::vector<const Level*> near(t.harmonic.size(), nullptr);
  for (const NearGroup& group : t.near) {
    const double share = 0.2 / static_cast<double>(t.near.size()),
                 from = 0.5 + share * static_cast<double>(near_grids.size());
    near_grids.push_back(run_near(group, source, part_of(monitor, from, from + share)));
    for (std::size_t i = 0; i < group.levels.size(); ++i)
      near[group.levels[i].harmonic] = &near_grids.back()[i];
  }

  to_splines(grids, part_of(monitor, 0.7, 0.72));

  // Sums of light that is never negative are held there. Whether it is, is looked up when it first matters.
  std::once_flag looked;
  bool negative = false;
  const std::function<bool()> hold_positive = [&] {
    std::call_once(looked, [&] { negative = has_negative(source); });
    return !negative;
  };

  struct Band {
    std::size_t level;
    int chart, row, rows;
  };
  std::vector<LevelTexels> texels;
  std::vector<Band> bands;
  for (std::size_t i = 0; i < t.harmonic.size(); ++i) {
    Map& map = results[static_cast<std::size_t>(t.harmonic[i].index)];
    const Matrix3 to_source = source.orientation * transpose(map.orientation);
    texels.emplace_back(t.harmonic[i], grids[i], near[i], bright, to_source, hold_positive, map);
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
        texels[band.level].rows(band.chart, band.row, band.rows);
      },
      part_of(monitor, 0.72, 1));
  return std::move(moments.reduced);
}

}  // namespace welkin
