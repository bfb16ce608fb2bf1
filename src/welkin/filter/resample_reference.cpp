#include "welkin/filter/resample_reference.h"
#include "welkin/base/error.h"
#include "welkin/base/parallel.h"
#include "welkin/filter/footprint.h"
#include "welkin/filter/refinement_reference.h"
#include "welkin/map/texel_points.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace welkin {
namespace {

using Values = std::vector<double>;

/// Weights of the texels first … first+count−1 along one axis.
struct Weights {
  int first = 0;
  int count = 1;
  std::array<double, 6> of{1.0};
};

double sinc(double x) {
  return x == 0 ? 1 : std::sin(kPi * x) / (kPi * x);
}

/// A kernel's height, t texels from its middle.
double kernel(Filter filter, double t) {
  t = std::fabs(t);
  switch (filter) {
    case Filter::bicubic:
      // Keys 1981, eq. 4, a = −½.
      if (t < 1) return (1.5 * t - 2.5) * t * t + 1;
      return t < 2 ? ((-0.5 * t + 2.5) * t - 4) * t + 2 : 0;
    case Filter::lanczos:
      return t < 3 ? sinc(t) * sinc(t / 3) : 0;
    case Filter::bilinear:
      return std::max(0.0, 1 - t);
    case Filter::nearest:
    case Filter::automatic:
      break;
  }
  return t <= 0.5 ? 1 : 0;
}

/// Texels on each side of a position that a kernel reads.
int reach(Filter filter) {
  switch (filter) {
    case Filter::bicubic:
      return 2;
    case Filter::lanczos:
      return 3;
    default:
      return 1;
  }
}

/// `position` 0…1 along an axis of `size` texels.
Weights weights_at(Filter filter, double position, int size) {
  if (filter == Filter::nearest) {
    return {static_cast<int>(clamp(std::floor(position * size), 0.0, size - 1.0)), 1, {1.0}};
  }
  const double x = clamp(position * size - 0.5, -0.5, size - 0.5);
  const int before = static_cast<int>(std::floor(x));
  Weights weights{before - reach(filter) + 1, 2 * reach(filter), {}};
  double total = 0;
  for (int i = 0; i < weights.count; ++i) {
    weights.of[static_cast<std::size_t>(i)] = kernel(filter, x - (weights.first + i));
    total += weights.of[static_cast<std::size_t>(i)];
  }
  for (double& w : weights.of) w /= total;
  return weights;
}

/// The rule of RingingFetch: at most half the range of the inner 4×4 texels beyond that range, and not below
/// half the minimum.
double limit_overshoot(const ImageView<const float>& chart, const Weights& across, const Weights& down,
                       int channel, double value) {
  const int margin = (across.count - 4) / 2;
  double minimum = HUGE_VAL, maximum = -HUGE_VAL;
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) {
      const double texel =
          static_cast<double>(chart.at(across.first + margin + i, down.first + margin + j)[channel]);
      minimum = std::min(minimum, texel);
      maximum = std::max(maximum, texel);
    }
  }
  const double beyond = 0.5 * (maximum - minimum);
  const double floor = std::max(minimum - beyond, std::min(minimum, 0.5 * minimum));
  return clamp(value, floor, maximum + beyond);
}

class Reference {
 public:
  Reference(const Map& source, const MapFrame& target, const ResampleOptions& options, int samples)
      : source_(source),
        target_(target),
        options_(options),
        to_source_(source.orientation * transpose(options.rotation) * transpose(target.orientation)),
        reconstructed_(options.filter == Filter::automatic && is_reconstructed(source, target, to_source_)),
        parts_(reconstructed_ && !options.allow_ringing
                   ? parts_for(footprints_of(source, target, to_source_).typical)
                   : 1),
        size_{source.width() * parts_, source.height() * parts_},
        refinement_(source.parameterization, source.level, parts_),
        by_row_(source.parameterization.density_by_row() && source.parameterization.full_charts()),
        samples_(options.filter == Filter::automatic ? samples : 1),
        fill_(options.fill.begin(), options.fill.end()) {
    require(samples >= 1, "resampling takes at least one sample for each texel");
    fill_.resize(static_cast<std::size_t>(source.channels()));
  }

  /// The values of a texel, one for each channel.
  Values texel(const TexelPlace& place) const {
    const auto& p = target_.parameterization;
    const auto [width, height] = target_.size;
    Values value(fill_.size()), sum(fill_.size()), low(fill_.size());
    Within last;
    double total = 0;
    for (int k = 0; k < samples_ * samples_; ++k) {
      const double u = (place.x + (k % samples_ + 0.5) / samples_) / width;
      const double v = (place.y + (k / samples_ + 0.5) / samples_) / height;
      if (!p.valid(place.chart, u, v)) continue;
      const double weight = samples_ == 1 ? 1.0 : p.solid_angle_density(place.chart, u, v);
      look_up(to_source_ * p.to_sphere(place.chart, u, v), last, low, value);
      total += weight;
      for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += weight * value[c];
    }
    // Points are looked up in texels on the rim too.
    if (!(total > 0) &&
        (p.filled_to_edges() ||
         (samples_ == 1 && !is_outside_texel(p, target_.size, place.chart, place.x, place.y)))) {
      look_up(to_source_ * p.to_sphere(place.chart, (place.x + 0.5) / width, (place.y + 0.5) / height), last,
              low, sum);
      total = 1;
    }
    if (!(total > 0)) return fill_;
    for (std::size_t c = 0; c < sum.size(); ++c) {
      sum[c] /= total;
      // The limiter leaves a little of an undershoot.
      if (reconstructed_ && !options_.allow_ringing && sum[c] < 0) sum[c] = std::max(sum[c], low[c]);
    }
    return sum;
  }

 private:
  /// Radiance within a texel of the source, or a part of one. Samples side by side mostly share one.
  struct Within {
    int chart = -1, x = 0, y = 0;
    /// Of each channel: the texel, and the coefficients of x, y, x² − 1/12, x·y and y² − 1/12.
    std::vector<std::array<double, 6>> of = {};
    std::vector<double> lowest = {};  ///< of each channel, of the 3×3 texels around and 0
    double density = 0;               ///< solid angle per area of the chart, its mean over the texel
    double bend = 0;                  ///< by what share of the mean it grows to the bottom
  };

  /// `low` goes down to the lowest of the texels that limit what is within one.
  void look_up(const Vec3d& d, Within& last, Values& low, Values& value) const {
    const auto& p = source_.parameterization;
    if (!p.covers(d)) {
      value = fill_;
      return;
    }
    const auto position = p.from_sphere(d);
    const ImageView<const float> chart = source_.level.chart(static_cast<int>(position.chart));
    if (options_.filter == Filter::automatic) {
      const double x = position.u * size_.width, y = position.v * size_.height;
      const int column = static_cast<int>(clamp(std::floor(x), 0.0, size_.width - 1.0)),
                row = static_cast<int>(clamp(std::floor(y), 0.0, size_.height - 1.0));
      const int number = static_cast<int>(position.chart);
      if (last.chart != number || last.x != column || last.y != row) last = within(number, column, row);
      // What differs from the texel's mean adds up to nothing over its area in the chart. So it is weighted
      // by that area, or where solid angle depends on the row alone, measured in solid angle down the row.
      const double px = x - column - 0.5;
      double py = y - row - 0.5, share = 1;
      if (by_row_) {
        py += last.bend * (py * py - 0.25);
      } else {
        const double density = p.solid_angle_density(number, position.u, position.v);
        if (density > 0 && last.density > 0) share = last.density / density;
      }
      for (std::size_t c = 0; c < value.size(); ++c) {
        const auto& a = last.of[c];
        value[c] = a[0] + share * (at(a, px, py) - a[0]);
        low[c] = std::min(low[c], last.lowest[c]);
      }
      return;
    }
    const Weights across = weights_at(options_.filter, position.u, source_.width());
    const Weights down = weights_at(options_.filter, position.v, source_.height());
    const bool rings = options_.filter == Filter::bicubic || options_.filter == Filter::lanczos;
    for (std::size_t c = 0; c < value.size(); ++c) {
      const int channel = static_cast<int>(c);
      value[c] = 0;
      for (int j = 0; j < down.count; ++j) {
        for (int i = 0; i < across.count; ++i) {
          const double weight = across.of[static_cast<std::size_t>(i)] * down.of[static_cast<std::size_t>(j)];
          value[c] += weight * static_cast<double>(chart.at(across.first + i, down.first + j)[channel]);
        }
      }
      if (rings && !options_.allow_ringing)
        value[c] = limit_overshoot(chart, across, down, channel, value[c]);
    }
  }

  /// Whether a texel is valid to its corners.
  bool is_whole(int chart, int x, int y) const {
    for (int k = 0; k < 4; ++k) {
      if (!source_.parameterization.valid(chart, static_cast<double>(x + k % 2) / source_.width(),
                                          static_cast<double>(y + k / 2) / source_.height()))
        return false;
    }
    return true;
  }

  Within within(int chart, int x, int y) const {
    Within texel{chart, x, y};
    const ImageView<const float> view = source_.level.chart(chart);
    const int column = x / parts_, row = y / parts_;
    const bool reconstructed = reconstructed_ && is_whole(chart, column, row);
    for (int c = 0; c < source_.channels(); ++c) {
      if (reconstructed) {
        texel.of.push_back(parts_ > 1 ? refinement_.within(chart, x, y, c) : reconstruction(view, x, y, c));
      } else {
        texel.of.push_back({static_cast<double>(view.at(column, row)[c])});
      }
      double lowest = 0;
      for (int k = 0; k < 9; ++k)
        lowest = std::min(lowest, static_cast<double>(view.at(column + k % 3 - 1, row + k / 3 - 1)[c]));
      texel.lowest.push_back(lowest);
    }
    if (reconstructed) {
      constexpr int kPoints = 4;
      const auto density = [&](double right, double down) {
        return std::max(0.0, source_.parameterization.solid_angle_density(chart, (x + right) / size_.width,
                                                                          (y + down) / size_.height));
      };
      for (int k = 0; k < kPoints * kPoints; ++k) {
        texel.density +=
            density((k % kPoints + 0.5) / kPoints, (k / kPoints + 0.5) / kPoints) / (kPoints * kPoints);
      }
      const double top = density(0.5, 0), bottom = density(0.5, 1);
      if (by_row_) texel.bend = (bottom - top) / (bottom + top);
    }
    return texel;
  }

  static double at(const std::array<double, 6>& a, double x, double y) {
    return a[0] + a[1] * x + a[2] * y + a[3] * (x * x - 1.0 / 12) + a[4] * x * y + a[5] * (y * y - 1.0 / 12);
  }

  /// As reconstruction.h has it.
  std::array<double, 6> reconstruction(const ImageView<const float>& chart, int column, int row,
                                       int channel) const {
    const auto texel = [&](int right, int down) {
      return static_cast<double>(chart.at(column + right, row + down)[channel]);
    };
    const double m = texel(0, 0);
    std::array<double, 6> a = free_quadratic(chart, column, row, channel);
    if (options_.allow_ringing) return a;
    double lowest = m, highest = m, low = m, high = m;
    for (int j = -1; j <= 1; ++j) {
      for (int i = -1; i <= 1; ++i) {
        lowest = std::min(lowest, at(a, 0.5 * i, 0.5 * j));
        highest = std::max(highest, at(a, 0.5 * i, 0.5 * j));
        low = std::min(low, texel(i, j));
        high = std::max(high, texel(i, j));
      }
    }
    const double beyond = static_cast<double>(kBeyond) * (high - low);
    const bool deep = lowest < -static_cast<double>(kDeep) * std::fabs(m);
    const double positive = deep ? std::min(low, std::max(0.5 * low, 0.0))
                                 : std::min(low, 0.0) - static_cast<double>(kUndershoot) * std::fabs(m);
    const double floor = std::max(positive, low - beyond), ceiling = high + beyond;
    double share = 1;
    if (lowest < floor) share = (m - floor) / (m - lowest);
    if (highest > ceiling) share = std::min(share, (ceiling - m) / (highest - m));
    for (std::size_t k = 1; k < a.size(); ++k) a[k] *= share;
    return a;
  }

  const Map& source_;
  const MapFrame target_;
  const ResampleOptions& options_;
  const Matrix3 to_source_;
  const bool reconstructed_;
  const int parts_;  ///< of a side of each of the source's texels
  const ChartSize size_;
  const RefinementReference refinement_;
  const bool by_row_;  ///< texels of a row of the source have one solid angle
  const int samples_;
  Values fill_;
};

}  // namespace

void resample_reference(const Map& source, Map& target, const ResampleOptions& options, int samples) {
  require(source.channels() == target.channels(),
          "the maps to resample between have other numbers of channels");
  const Reference reference(source, target, options, samples);
  parallel_for(
      target.charts() * target.height(),
      [&](int i) {
        TexelPlace place{i / target.height(), 0, i % target.height()};
        for (; place.x < target.width(); ++place.x) {
          const Values values = reference.texel(place);
          float* out = target.level.chart(place.chart).at(place.x, place.y);
          for (const double value : values) *out++ = static_cast<float>(value);
        }
      },
      options.monitor);
}

std::vector<double> resample_reference(const Map& source, const MapFrame& target,
                                       const ResampleOptions& options, int samples,
                                       std::span<const TexelPlace> texels) {
  const Reference reference(source, target, options, samples);
  const std::size_t channels = static_cast<std::size_t>(source.channels());
  std::vector<double> all(texels.size() * channels);
  parallel_for(
      static_cast<int>(texels.size()),
      [&](int i) {
        const std::size_t k = static_cast<std::size_t>(i);
        const TexelPlace& place = texels[k];
        require(place.chart >= 0 && place.chart < target.parameterization.charts() && place.x >= 0 &&
                    place.x < target.size.width && place.y >= 0 && place.y < target.size.height,
                "there is no such texel");
        const Values values = reference.texel(place);
        std::copy(values.begin(), values.end(), all.begin() + static_cast<std::ptrdiff_t>(k * channels));
      },
      options.monitor);
  return all;
}

}  // namespace welkin
