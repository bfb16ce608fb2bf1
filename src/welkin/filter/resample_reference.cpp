#include "welkin/filter/resample_reference.h"
#include "welkin/base/error.h"
#include "welkin/base/parallel.h"
#include "welkin/filter/footprint.h"
#include "welkin/filter/reconstruction.h"

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
  Reference(const Map& source, Map& target, const ResampleOptions& options, int samples)
      : source_(source),
        target_(target),
        options_(options),
        reconstructed_(options.filter == Filter::automatic &&
                       is_reconstructed(
                           source, target,
                           source.orientation * transpose(options.rotation) * transpose(target.orientation))),
        samples_(options.filter == Filter::automatic ? samples : 1),
        to_source_(source.orientation * transpose(options.rotation) * transpose(target.orientation)),
        fill_(options.fill.begin(), options.fill.end()) {
    require(source.channels() == target.channels(),
            "the maps to resample between have other numbers of channels");
    require(samples >= 1, "resampling takes at least one sample for each texel");
    fill_.resize(static_cast<std::size_t>(source.channels()));
  }

  void row(int chart, int y) {
    Values value(fill_.size()), sum(fill_.size());
    for (int x = 0; x < target_.width(); ++x) {
      double total = 0;
      std::fill(sum.begin(), sum.end(), 0.0);
      for (int k = 0; k < samples_ * samples_; ++k) {
        const double u = (x + (k % samples_ + 0.5) / samples_) / target_.width();
        const double v = (y + (k / samples_ + 0.5) / samples_) / target_.height();
        const auto& p = target_.parameterization;
        if (!p.valid(chart, u, v)) continue;
        const double weight = samples_ == 1 ? 1.0 : p.solid_angle_density(chart, u, v);
        look_up(to_source_ * p.to_sphere(chart, u, v), value);
        total += weight;
        for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += weight * value[c];
      }
      if (!(total > 0) && target_.parameterization.filled_to_edges()) {
        const double u = (x + 0.5) / target_.width(), v = (y + 0.5) / target_.height();
        look_up(to_source_ * target_.parameterization.to_sphere(chart, u, v), sum);
        total = 1;
      }
      float* out = target_.level.chart(chart).at(x, y);
      for (std::size_t c = 0; c < sum.size(); ++c) {
        out[c] = static_cast<float>(total > 0 ? sum[c] / total : fill_[c]);
      }
    }
  }

 private:
  void look_up(const Vec3d& d, Values& value) const {
    const auto& p = source_.parameterization;
    if (!p.covers(d)) {
      value = fill_;
      return;
    }
    const auto position = p.from_sphere(d);
    const ImageView<const float> chart = source_.level.chart(static_cast<int>(position.chart));
    if (options_.filter == Filter::automatic) {
      const double x = position.u * source_.width(), y = position.v * source_.height();
      const int column = static_cast<int>(clamp(std::floor(x), 0.0, source_.width() - 1.0)),
                row = static_cast<int>(clamp(std::floor(y), 0.0, source_.height() - 1.0));
      const bool within = reconstructed_ && is_whole(static_cast<int>(position.chart), column, row);
      for (std::size_t c = 0; c < value.size(); ++c) {
        const int channel = static_cast<int>(c);
        value[c] = within ? radiance_within(chart, column, row, channel, x - column - 0.5, y - row - 0.5)
                          : static_cast<double>(chart.at(column, row)[channel]);
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

  /// The reconstruction of reconstruction.h at (x, y), −½…½ from the texel's centre.
  double radiance_within(const ImageView<const float>& chart, int column, int row, int channel, double x,
                         double y) const {
    const auto texel = [&](int right, int down) {
      return static_cast<double>(chart.at(column + right, row + down)[channel]);
    };
    const auto odd = [](const auto& value) {
      double sum = 0;
      for (int j = 1; j <= kReconstructionReach; ++j)
        sum += static_cast<double>(kOddTaps[j - 1]) * (value(j) - value(-j));
      return sum;
    };
    const auto even = [](const auto& value) {
      double sum = 0;
      for (int j = 1; j <= kReconstructionReach; ++j)
        sum += static_cast<double>(kEvenTaps[j - 1]) * (value(j) + value(-j) - 2 * value(0));
      return sum;
    };
    const double m = texel(0, 0);
    double a[5] = {odd([&](int j) { return texel(j, 0); }), odd([&](int j) { return texel(0, j); }),
                   even([&](int j) { return texel(j, 0); }),
                   odd([&](int k) { return odd([&](int j) { return texel(j, k); }); }),
                   even([&](int j) { return texel(0, j); })};
    const auto at = [&](double px, double py) {
      return m + a[0] * px + a[1] * py + a[2] * (px * px - 1.0 / 12) + a[3] * px * py +
             a[4] * (py * py - 1.0 / 12);
    };
    if (!options_.allow_ringing) {
      double lowest = m, highest = m, low = m, high = m;
      for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i) {
          lowest = std::min(lowest, at(0.5 * i, 0.5 * j));
          highest = std::max(highest, at(0.5 * i, 0.5 * j));
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
      for (double& each : a) each *= share;
    }
    return at(x, y);
  }

  const Map& source_;
  Map& target_;
  const ResampleOptions& options_;
  const bool reconstructed_;
  const int samples_;
  const Matrix3 to_source_;
  Values fill_;
};

}  // namespace

void resample_reference(const Map& source, Map& target, const ResampleOptions& options, int samples) {
  Reference reference(source, target, options, samples);
  parallel_for(
      target.charts() * target.height(),
      [&](int i) { reference.row(i / target.height(), i % target.height()); }, options.monitor);
}

}  // namespace welkin
