#include "welkin/prefilter/harmonics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "welkin/base/parallel.h"
#include "welkin/prefilter/bright_points.h"
#include "welkin/prefilter/kernels.h"
#include "welkin/prefilter/level_texels.h"
#include "welkin/prefilter/plan.h"
#include "welkin/prefilter/spline_grid.h"

namespace welkin::prefilter {
namespace {

using Tables = PrefilterPlan::Tables;

/// Where the coefficients of order m begin, degrees m … degree one after the other.
std::size_t offset_of(int m, int degree) {
  const std::size_t n = static_cast<std::size_t>(m);
  return n * static_cast<std::size_t>(degree + 1) - n * (n - 1) / 2;
}

/// The pipeline for up to three channels from `first`.
class Harmonics {
 public:
  Harmonics(const HarmonicAnalysis& analysis, const std::vector<HarmonicLevel>& levels, PointGrid& points,
            const BrightPoints& bright, int first, int channels, std::vector<Level>& grids)
      : a_(analysis),
        levels_(levels),
        points_(points),
        bright_(bright),
        first_(first),
        channels_(channels),
        parts_(2 * channels),
        grids_(grids) {}

  /// `power`: see synthesise_levels; null: not wanted.
  void run(std::vector<double>* power, const Monitor& monitor) {
    // What is done with gives its memory to what comes next.
    transform_rows(part_of(monitor, 0, 0.1));
    if (first_ + channels_ == points_.channels) points_.lanes = Buffer();
    analyse(part_of(monitor, 0.1, 0.4));
    orders_ = Buffer();
    if (power != nullptr) add_power(*power);
    if (std::any_of(levels_.begin(), levels_.end(), [](const auto& level) { return level.all; }))
      add_bright();
    // Some levels at a time, whose orders take the memory of those before.
    constexpr std::size_t kMost = std::size_t{4} << 20;
    for (std::size_t first = 0, last = 0; first < levels_.size(); first = last) {
      for (std::size_t size = 0; last < levels_.size() && (size == 0 || size < kMost); ++last)
        size += orders_of(levels_[last]);
      const auto at = [&](double part) {
        return 0.4 + 0.6 * (static_cast<double>(first) + part * static_cast<double>(last - first)) /
                         static_cast<double>(levels_.size());
      };
      synthesise(first, last, part_of(monitor, at(0), at(0.75)));
      transform_back(first, last, part_of(monitor, at(0.75), at(1)));
    }
    coefficients_ = Buffer();
    all_coefficients_ = Buffer();
  }

 private:
  std::size_t order_size(const Latitudes& latitudes) const {
    return static_cast<std::size_t>(latitudes.packs) * 2 * static_cast<std::size_t>(parts_) * 8;
  }

  /// Values of all of a level's orders.
  std::size_t orders_of(const HarmonicLevel& level) const {
    return order_size(level.latitudes) * static_cast<std::size_t>(level.degree + 1);
  }

  void transform_rows(const Monitor& monitor) {
    const Latitudes& latitudes = a_.latitudes;
    orders_ = Buffer(order_size(latitudes) * static_cast<std::size_t>(a_.degree + 1));
    parallel_for(
        points_.packs,
        [&](int pack) {
          Buffer work(static_cast<std::size_t>(points_.width) * 16);
          for (int c = 0; c < channels_; ++c) {
            float* orders = orders_.data() + (static_cast<std::ptrdiff_t>(pack) * 2 * parts_ + 2 * c) * 8;
            kernels().rows_to_orders(a_.fft, points_.at(pack, first_ + c), work.data(), a_.factors.data(),
                                     a_.degree, points_.packs, parts_, orders);
          }
        },
        monitor);
  }

  void analyse(const Monitor& monitor) {
    const Latitudes& latitudes = a_.latitudes;
    coefficients_ = Buffer(offset_of(a_.degree + 1, a_.degree) * static_cast<std::size_t>(parts_));
    parallel_for(
        a_.degree + 1,
        [&](int m) {
          Buffer work(static_cast<std::size_t>((a_.degree + 2) * parts_ * 8));
          kernels().analyse[channels_ - 1](
              latitudes, a_.recurrences[static_cast<std::size_t>(m)], a_.degree,
              orders_.data() + order_size(latitudes) * static_cast<std::size_t>(m), work.data(),
              coefficients_.data() + offset_of(m, a_.degree) * static_cast<std::size_t>(parts_));
        },
        monitor);
  }

  /// Of degrees up to half of the last, which the points give precisely.
  void add_power(std::vector<double>& power) const {
    for (int m = 0; m <= a_.degree / 2; ++m) {
      const float* a = coefficients_.data() + offset_of(m, a_.degree) * static_cast<std::size_t>(parts_);
      for (int l = m; l <= a_.degree / 2; ++l, a += parts_) {
        for (int part = 0; part < parts_; ++part) {
          const double value = static_cast<double>(a[part]);
          power[static_cast<std::size_t>(first_ + part / 2)] += (m > 0 ? 2 : 1) * value * value;
        }
      }
    }
  }

  /// What far parts of narrow lobes and smooth lobes need: the coefficients of all points, the bright ones
  /// included.
  void add_bright() {
    const std::size_t size = offset_of(a_.degree + 1, a_.degree) * static_cast<std::size_t>(parts_);
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
      angles.push_back(2 * kPi * (u - 0.5 / points_.width));
    }
    const Latitudes latitudes(cosines, a_.degree);
    parallel_for(a_.degree + 1, [&](int m) {
      std::vector<float> rows(order_size(latitudes), 0.0f);
      for (std::size_t i = 0; i < count; ++i) {
        const float re = static_cast<float>(std::cos(m * angles[i])),
                    im = static_cast<float>(-std::sin(m * angles[i]));
        const float side = bright_.y[i] < 0 ? -1.0f : 1.0f;
        float* even = rows.data() + i / 8 * 16 * static_cast<std::size_t>(parts_) + i % 8;
        float* odd = even + 8 * parts_;
        for (int c = 0; c < channels_; ++c) {
          const float weight = bright_.weight[i * static_cast<std::size_t>(bright_.channels) +
                                              static_cast<std::size_t>(first_ + c)];
          even[16 * c] = weight * re;
          even[16 * c + 8] = weight * im;
          odd[16 * c] = side * weight * re;
          odd[16 * c + 8] = side * weight * im;
        }
      }
      Buffer work(static_cast<std::size_t>((a_.degree + 2) * parts_ * 8));
      const std::size_t terms = static_cast<std::size_t>((a_.degree - m + 1) * parts_);
      std::vector<float> sums(terms);
      kernels().analyse[channels_ - 1](latitudes, a_.recurrences[static_cast<std::size_t>(m)], a_.degree,
                                       rows.data(), work.data(), sums.data());
      float* to = all_coefficients_.data() + offset_of(m, a_.degree) * static_cast<std::size_t>(parts_);
      for (std::size_t k = 0; k < terms; ++k) to[k] += sums[k];
    });
  }

  /// Of levels [first, last).
  void synthesise(std::size_t first, std::size_t last, const Monitor& monitor) {
    struct Item {
      std::size_t level;
      int m;
    };
    std::vector<Item> items;
    level_orders_.resize(levels_.size());
    for (std::size_t i = first; i < last; ++i) {
      const HarmonicLevel& level = levels_[i];
      level_orders_[i] = Buffer(orders_of(level));
      for (int m = 0; m <= level.degree; ++m) items.push_back({i, m});
    }
    parallel_for(
        static_cast<int>(items.size()),
        [&](int k) {
          const auto [i, m] = items[static_cast<std::size_t>(k)];
          synthesise_order(
              levels_[i], levels_[i].all ? all_coefficients_ : coefficients_, m,
              level_orders_[i].data() + order_size(levels_[i].latitudes) * static_cast<std::size_t>(m));
        },
        monitor);
  }

  void synthesise_order(const HarmonicLevel& level, const Buffer& coefficients, int m, float* orders) {
    const Recurrence& r = a_.recurrences[static_cast<std::size_t>(m)];
    const float* a = coefficients.data() + offset_of(m, a_.degree) * static_cast<std::size_t>(parts_);
    const float cosine = level.phases[static_cast<std::size_t>(2 * m)];
    const float sine = level.phases[static_cast<std::size_t>(2 * m + 1)];
    std::vector<float> scaled(static_cast<std::size_t>((level.degree - m + 1) * parts_));
    float* to = scaled.data();
    for (int l = m; l <= level.degree; ++l, a += parts_, to += parts_) {
      const float factor = level.zonal[static_cast<std::size_t>(l)] *
                           static_cast<float>(r.scale[static_cast<std::size_t>(l - m)]);
      const float phase_re = factor * cosine, phase_im = factor * sine;
      for (int p = 0; p < parts_; p += 2) {
        to[p] = a[p] * phase_re - a[p + 1] * phase_im;
        to[p + 1] = a[p] * phase_im + a[p + 1] * phase_re;
      }
    }
    kernels().synthesise[channels_ - 1](level.latitudes, r, level.degree, scaled.data(), orders);
  }

  /// And gives their orders' memory back.
  void transform_back(std::size_t first, std::size_t last, const Monitor& monitor) {
    if (grids_.empty()) {
      for (const HarmonicLevel& level : levels_)
        grids_.emplace_back(1, level.grid.width, level.grid.height, points_.channels, PixelContents::unset);
    }
    struct Item {
      std::size_t level;
      int pack;
    };
    std::vector<Item> items;
    for (std::size_t i = first; i < last; ++i) {
      for (int pack = 0; pack < levels_[i].latitudes.packs; ++pack) items.push_back({i, pack});
    }
    parallel_for(
        static_cast<int>(items.size()),
        [&](int k) {
          const auto [i, pack] = items[static_cast<std::size_t>(k)];
          const HarmonicLevel& level = levels_[i];
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
    for (std::size_t i = first; i < last; ++i) level_orders_[i] = Buffer();
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

  const HarmonicAnalysis& a_;
  const std::vector<HarmonicLevel>& levels_;
  PointGrid& points_;
  const BrightPoints& bright_;
  int first_, channels_, parts_;
  std::vector<Level>& grids_;
  Buffer orders_, coefficients_, all_coefficients_;
  std::vector<Buffer> level_orders_;
};

}  // namespace

std::vector<float> order_factors(const PointGridPlan& points, int last) {
  std::vector<float> factors;
  for (int m = 0; m <= last; ++m) {
    const double x = kPi * m / points.width;
    const bool box = points.way == PointGridPlan::Way::spread_boxes && m > 0;
    factors.push_back(static_cast<float>(box ? std::sin(x) / x : 1.0));
  }
  return factors;
}

std::vector<float> phases(int last, int grid_width, int points_width) {
  std::vector<float> phase_factors;
  for (int m = 0; m <= last; ++m) {
    const double shift = kPi * m * (1.0 / grid_width - 1.0 / points_width);
    const double spline = 6 * 3 / (2 + std::cos(2 * kPi * m / grid_width));
    phase_factors.push_back(static_cast<float>(spline * std::cos(shift)));
    phase_factors.push_back(static_cast<float>(spline * std::sin(shift)));
  }
  return phase_factors;
}

HarmonicAnalysis::HarmonicAnalysis(const PrefilterShape& source, int maximum, PointGridPlan::Rows use)
    : degree(maximum),
      points(source.parameterization, source.size, degree, use),
      fft(points.width),
      latitudes(points.height, degree),
      factors(order_factors(points, degree)) {
  for (int m = 0; m <= degree; ++m) recurrences.emplace_back(m, degree);
}

HarmonicLevel::HarmonicLevel(const WidenedLobe& widened, const std::vector<double>& coefficients, int number,
                             int points_width)
    : index(number),
      degree(static_cast<int>(coefficients.size()) - 1),
      grid{fft_length(static_cast<int>(2.2 * degree) + 8), 0},
      fft(grid.width),
      latitudes(grid.width / 2, degree),
      zonal(coefficients.begin(), coefficients.end()),
      phases(prefilter::phases(degree, grid.width, points_width)),
      lobe(widened.lobe),
      all(widened.smooth),
      scale(1 / widened.lobe.integral()) {
  grid.height = grid.width / 2;
}

std::vector<Level> synthesise_levels(const HarmonicAnalysis& analysis,
                                     const std::vector<HarmonicLevel>& levels, PointGrid& points,
                                     const BrightPoints& bright, std::vector<double>* power,
                                     const Monitor& monitor) {
  if (power != nullptr) power->assign(static_cast<std::size_t>(points.channels), 0.0);
  std::vector<Level> grids;
  for (int first = 0; first < points.channels; first += 3) {
    const int channels = std::min(3, points.channels - first);
    const double share = 1.0 / points.channels;
    Harmonics(analysis, levels, points, bright, first, channels, grids)
        .run(power, part_of(monitor, first * share, (first + channels) * share));
  }
  return grids;
}

HarmonicResults run_harmonics(const Tables& t, const Map& source, const Monitor& monitor) {
  PointGrid points = make_point_grid(source, t.analysis->points, part_of(monitor, 0, 0.2));
  const BrightPoints bright = take_bright_points(points, {}, part_of(monitor, 0.2, 0.22));
  std::vector<Level> grids =
      synthesise_levels(*t.analysis, t.harmonic, points, bright, nullptr, part_of(monitor, 0.22, 0.5));

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
  return {make_level_texels(t, t.harmonic, grids, near, bright, source, part_of(monitor, 0.72, 1))};
}

}  // namespace welkin::prefilter
