#include "welkin/measure/compare.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "welkin/base/error.h"
#include "welkin/base/parallel.h"
#include "welkin/filter/fetch.h"
#include "welkin/image/color_ramp.h"
#include "welkin/map/borders.h"
#include "welkin/map/row_bands.h"
#include "welkin/map/texel_points.h"
#include "welkin/measure/common_channels.h"

namespace welkin {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Position {
  int row = 0;  ///< of all charts
  int x = 0;
};

/// The largest value so far, and where.
struct Largest {
  double value = 0;
  Position position;

  void take(double other, const Position& where) {
    if (other > value) {
      value = other;
      position = where;
    }
  }
};

struct ChannelSums {
  double a = 0, b = 0, squared_a = 0, squared_error = 0, squared_log_error = 0, absolute_error = 0;
  double maximum_a = -kInfinity;
  Largest error, relative;

  void add(const ChannelSums& other) {
    a += other.a;
    b += other.b;
    squared_a += other.squared_a;
    squared_error += other.squared_error;
    squared_log_error += other.squared_log_error;
    absolute_error += other.absolute_error;
    maximum_a = std::max(maximum_a, other.maximum_a);
    error.take(other.error.value, other.error.position);
    relative.take(other.relative.value, other.relative.position);
  }
};

struct Sums {
  std::vector<ChannelSums> channels;
  Largest relative;    ///< of all channels together
  double covered = 0;  ///< weight of the texels of the grid
  double weight = 0;   ///< of those compared
  std::uint64_t texels = 0, skipped = 0;

  void add(const Sums& other) {
    for (std::size_t c = 0; c < channels.size(); ++c) channels[c].add(other.channels[c]);
    relative.take(other.relative.value, other.relative.position);
    covered += other.covered;
    weight += other.weight;
    texels += other.texels;
    skipped += other.skipped;
  }
};

/// (ln(1 + b) − ln(1 + a))² of values that aren't negative.
double squared_log_ratio(double a, double b) {
  if (a == b) return 0;
  const double light = std::max(a, 0.0);
  const double logarithm = std::log1p((std::max(b, 0.0) - light) / (1 + light));
  return logarithm * logarithm;
}

double ratio(double a, double b) {
  return a == 0 ? 0 : b > 0 ? a / b : kInfinity;
}

class Comparer {
 public:
  Comparer(const Map& a, const Map& b, const CompareOptions& options)
      : options_(options),
        a_(a),
        b_(b),
        pairs_(common_channels(a.channel_names, b.channel_names)),
        texel_by_texel_(a.parameterization == b.parameterization && a.width() == b.width() &&
                        a.height() == b.height() && a.orientation == b.orientation),
        grid_is_a_(texels_of(a) >= texels_of(b)),
        grid_(grid_is_a_ ? a : b),
        other_(grid_is_a_ ? b : a),
        to_other_(other_.orientation * transpose(grid_.orientation)),
        fetch_(fetch_for(options.filter, false, other_.channels())),
        other_level_(view_of(other_.level)),
        bands_(grid_.charts() * grid_.height()) {}

  Comparison run(Map* heat) {
    Sums sums = add_up([&](int band, Sums& out) { add_up_band(band, out); }, options_.monitor);
    floors_.clear();
    for (const ChannelSums& channel : sums.channels) {
      floors_.push_back(kRelativeFloor * std::sqrt(ratio(channel.squared_a, sums.weight)));
    }
    floor_of_all_ = 0;
    for (std::size_t c = 0; c < pairs_.size(); ++c) {
      if (pairs_[c].counts) floor_of_all_ += floors_[c] * floors_[c] / counting();
    }
    floor_of_all_ = std::sqrt(floor_of_all_);
    std::optional<Map> error;
    if (heat != nullptr) {
      error.emplace(grid_.parameterization, grid_.width(), grid_.height(), 2);
      error->orientation = grid_.orientation;
    }
    const Sums relative =
        add_up([&](int band, Sums& out) { find_relative(band, out, error ? &*error : nullptr); },
               {nullptr, options_.monitor.cancelled});
    for (std::size_t c = 0; c < pairs_.size(); ++c) sums.channels[c].relative = relative.channels[c].relative;
    sums.relative = relative.relative;
    if (error) paint(*error, *heat);
    Comparison result = conclude(sums);
    add_energy(result);
    return result;
  }

 private:
  static std::int64_t texels_of(const Map& map) {
    return static_cast<std::int64_t>(map.charts()) * map.width() * map.height();
  }

  template <class Body>
  Sums add_up(const Body& body, const Monitor& monitor) const {
    std::vector<Sums> bands(static_cast<std::size_t>(bands_.count));
    parallel_for(
        bands_.count,
        [&](int i) {
          bands[static_cast<std::size_t>(i)].channels.resize(pairs_.size());
          body(i, bands[static_cast<std::size_t>(i)]);
        },
        monitor);
    Sums total = std::move(bands[0]);
    for (std::size_t i = 1; i < bands.size(); ++i) total.add(bands[i]);
    return total;
  }

  /// Calls body(position, weight, texel of a, texel of b) for every texel of a band that both maps show; its
  /// solid angle is weight·scale, with one scale for all.
  template <class Body>
  void for_each_texel(int band, double& covered, const Body& body) const {
    constexpr int kBatch = 256;
    alignas(64) float u[kBatch], v[kBatch], x[kBatch], y[kBatch], z[kBatch];
    alignas(64) float chart[kBatch], other_u[kBatch], other_v[kBatch], covers[kBatch];
    const auto& grid = grid_.parameterization;
    const auto& other = other_.parameterization;
    const int width = grid_.width(), height = grid_.height();
    const std::ptrdiff_t grid_channels = grid_.channels(), other_channels = other_.channels();
    std::vector<float> weights(static_cast<std::size_t>(width));
    std::vector<float> values(static_cast<std::size_t>(kBatch * other_channels + 8));
    std::fill(std::begin(covers), std::end(covers), 1.0f);
    for (int row = bands_.first(band); row < bands_.first(band + 1); ++row) {
      const int grid_chart = row / height, grid_y = row % height;
      centred_solid_angles(grid, {width, height}, grid_chart, grid_y, weights.data());
      for (const float weight : weights) covered += static_cast<double>(weight);
      std::fill(std::begin(v), std::end(v), (static_cast<float>(grid_y) + 0.5f) / static_cast<float>(height));
      for (int start = 0; start < width; start += kBatch) {
        const int count = std::min(kBatch, width - start);
        const std::size_t size = static_cast<std::size_t>(count);
        const float* grid_texel = grid_.level.chart(grid_chart).at(start, grid_y);
        const float* other_texel = values.data();
        if (texel_by_texel_) {
          other_texel = other_.level.chart(grid_chart).at(start, grid_y);
        } else {
          for (int i = 0; i < kBatch; ++i) {
            u[i] = (static_cast<float>(std::min(start + i, width - 1)) + 0.5f) / static_cast<float>(width);
          }
          grid.kernels().to_sphere(grid.self(), grid_chart, u, v, x, y, z, size);
          rotate(x, y, z, sphere::padded(size));
          other.kernels().from_sphere(other.self(), x, y, z, chart, other_u, other_v, size);
          if (!other.whole_world()) other.kernels().covers(other.self(), x, y, z, covers, size);
          fetch_(other_level_, chart, other_u, other_v, values.data(), size);
        }
        for (int i = 0; i < count; ++i, grid_texel += grid_channels, other_texel += other_channels) {
          const double weight = static_cast<double>(weights[static_cast<std::size_t>(start + i)]);
          if (!(weight > 0) || !(covers[i] > 0)) continue;
          body(Position{row, start + i}, weight, grid_is_a_ ? grid_texel : other_texel,
               grid_is_a_ ? other_texel : grid_texel);
        }
      }
    }
  }

  void rotate(float* x, float* y, float* z, std::size_t count) const {
    if (to_other_ == Matrix3{}) return;
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3d d =
          to_other_ * Vec3d{static_cast<double>(x[i]), static_cast<double>(y[i]), static_cast<double>(z[i])};
      x[i] = static_cast<float>(d.x);
      y[i] = static_cast<float>(d.y);
      z[i] = static_cast<float>(d.z);
    }
  }

  bool all_finite(const float* a, const float* b) const {
    return std::all_of(pairs_.begin(), pairs_.end(), [&](const ChannelPair& pair) {
      return std::isfinite(a[pair.a]) && std::isfinite(b[pair.b]);
    });
  }

  void add_up_band(int band, Sums& sums) const {
    for_each_texel(band, sums.covered,
                   [&](const Position& position, double weight, const float* a, const float* b) {
                     if (!all_finite(a, b)) {
                       ++sums.skipped;
                       return;
                     }
                     ++sums.texels;
                     sums.weight += weight;
                     for (std::size_t c = 0; c < pairs_.size(); ++c) {
                       ChannelSums& channel = sums.channels[c];
                       const double value_a = static_cast<double>(a[pairs_[c].a]),
                                    value_b = static_cast<double>(b[pairs_[c].b]);
                       const double error = value_b - value_a;
                       channel.a += weight * value_a;
                       channel.b += weight * value_b;
                       channel.squared_a += weight * value_a * value_a;
                       channel.squared_error += weight * error * error;
                       channel.squared_log_error += weight * squared_log_ratio(value_a, value_b);
                       channel.absolute_error += weight * std::fabs(error);
                       channel.maximum_a = std::max(channel.maximum_a, value_a);
                       channel.error.take(std::fabs(error), position);
                     }
                   });
  }

  /// The second pass, when the floors are known. `out`, if given, gets relative error and 1 where texels are
  /// compared.
  void find_relative(int band, Sums& sums, Map* out) const {
    for_each_texel(band, sums.covered, [&](const Position& position, double, const float* a, const float* b) {
      if (!all_finite(a, b)) return;
      double squared_error = 0, squared_a = 0;
      for (std::size_t c = 0; c < pairs_.size(); ++c) {
        const double value_a = static_cast<double>(a[pairs_[c].a]);
        const double error = static_cast<double>(b[pairs_[c].b]) - value_a;
        sums.channels[c].relative.take(ratio(std::fabs(error), std::max(std::fabs(value_a), floors_[c])),
                                       position);
        if (pairs_[c].counts) {
          squared_error += error * error / counting();
          squared_a += value_a * value_a / counting();
        }
      }
      const double relative = ratio(std::sqrt(squared_error), std::max(std::sqrt(squared_a), floor_of_all_));
      sums.relative.take(relative, position);
      if (out != nullptr) {
        float* texel =
            out->level.chart(position.row / grid_.height()).at(position.x, position.row % grid_.height());
        texel[0] = static_cast<float>(std::min(relative, 1e6));
        texel[1] = 1;
      }
    });
  }

  void paint(Map& error, Map& heat) const {
    fill_borders(error);
    Map mean(sphere::AnyParameterization::make("latlong"), options_.heat_width, options_.heat_width / 2, 2);
    resample(error, mean);
    heat = Map(mean.parameterization, mean.width(), mean.height(), 3);
    for (int y = 0; y < mean.height(); ++y) {
      for (int x = 0; x < mean.width(); ++x) {
        const float* from = mean.level.chart(0).at(x, y);
        const double value = static_cast<double>(from[0] / from[1]);
        const double decades = std::log10(std::max(value, kHeatMinimum) / kHeatMinimum);
        const auto color =
            from[1] > 0.5f ? color_ramp(decades / std::log10(kHeatMaximum / kHeatMinimum)) : neutral_color();
        std::copy(color.begin(), color.end(), heat.level.chart(0).at(x, y));
      }
    }
    fill_borders(heat);
  }

  double counting() const {
    return static_cast<double>(
        std::count_if(pairs_.begin(), pairs_.end(), [](const ChannelPair& pair) { return pair.counts; }));
  }

  Vec3d direction_of(const Position& position) const {
    return transpose(grid_.orientation) *
           grid_.parameterization.to_sphere(position.row / grid_.height(), (position.x + 0.5) / grid_.width(),
                                            (position.row % grid_.height() + 0.5) / grid_.height());
  }

  /// `weight` is the sum of weights, over all channels that `sums` is of.
  ErrorMeasures measures(const std::string& name, const ChannelSums& sums, double weight, double peak) const {
    ErrorMeasures result;
    result.name = name;
    if (!(weight > 0)) return result;
    result.mean_a = sums.a / weight;
    result.mean_b = sums.b / weight;
    result.energy_ratio = result.mean_a == result.mean_b ? 1 : result.mean_b / result.mean_a;
    result.rms_a = std::sqrt(sums.squared_a / weight);
    result.rmse = std::sqrt(sums.squared_error / weight);
    result.relative_rmse = ratio(result.rmse, result.rms_a);
    result.rmsle = std::sqrt(sums.squared_log_error / weight);
    result.mean_absolute = sums.absolute_error / weight;
    result.maximum_absolute = sums.error.value;
    result.maximum_absolute_direction = direction_of(sums.error.position);
    result.maximum_relative = sums.relative.value;
    result.maximum_relative_direction = direction_of(sums.relative.position);
    result.psnr = result.rmse > 0 ? 20 * std::log10(peak / result.rmse) : kInfinity;
    return result;
  }

  Comparison conclude(const Sums& sums) const {
    Comparison result;
    result.texel_by_texel = texel_by_texel_;
    result.texels = sums.texels;
    result.skipped = sums.skipped;
    result.solid_angle = ratio(sums.weight, sums.covered) * grid_.parameterization.coverage();
    ChannelSums all;
    for (std::size_t c = 0; c < pairs_.size(); ++c) {
      if (pairs_[c].counts) all.add(sums.channels[c]);
    }
    all.relative = sums.relative;
    result.peak = options_.peak > 0 ? options_.peak : std::max(all.maximum_a, 1.0);
    result.all = measures("all", all, sums.weight * counting(), result.peak);
    for (std::size_t c = 0; c < pairs_.size(); ++c) {
      result.channels.push_back(measures(pairs_[c].name, sums.channels[c], sums.weight, result.peak));
    }
    return result;
  }

  /// Energy is no matter of interpolation: each map has its own.
  void add_energy(Comparison& result) const {
    EnergyOptions options;
    options.lights = options_.lights;
    options.monitor = without_progress(options_.monitor);
    result.energy = compare_energy(a_, b_, options);
    const EnergyChange& whole = result.energy.whole;
    double before = 0, after = 0;
    std::size_t counted = 0;
    for (std::size_t c = 0; c < pairs_.size(); ++c) {
      if (!pairs_[c].counts) continue;
      result.channels[c].energy_ratio = whole.ratios[counted];
      before += whole.before.channels[counted];
      after += whole.after.channels[counted++];
    }
    result.all.energy_ratio = before == after ? 1 : after / before;
  }

  const CompareOptions& options_;
  const Map& a_;
  const Map& b_;
  const std::vector<ChannelPair> pairs_;
  const bool texel_by_texel_;
  const bool grid_is_a_;
  const Map& grid_;
  const Map& other_;
  const Matrix3 to_other_;
  const Fetch fetch_;
  const LevelView other_level_;
  const RowBands bands_;
  std::vector<double> floors_;
  double floor_of_all_ = 0;
};

}  // namespace

Comparison compare(const Map& a, const Map& b, const CompareOptions& options, Map* heat) {
  if (!(options.peak >= 0) || std::isinf(options.peak)) {
    throw Error(ErrorKind::bad_request, "the peak of PSNR must be a positive number, or 0 for the default");
  }
  constexpr int kWidest = 1 << 15;
  if (heat != nullptr && (options.heat_width < 2 || options.heat_width > kWidest)) {
    throw Error(ErrorKind::bad_request, "the heat map's width must be 2 to " + std::to_string(kWidest) +
                                            ", not " + std::to_string(options.heat_width));
  }
  return Comparer(a, b, options).run(heat);
}

}  // namespace welkin
