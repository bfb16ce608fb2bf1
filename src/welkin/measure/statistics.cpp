#include "welkin/measure/statistics.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "welkin/base/parallel.h"
#include "welkin/map/luminance.h"
#include "welkin/map/row_bands.h"

namespace welkin {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Bins of a positive float are its exponent and the first six bits of its fraction.
constexpr int kBinShift = 17;
constexpr std::size_t kBins = std::size_t{1} << (31 - kBinShift);

std::size_t bin_of(float positive) {
  return std::bit_cast<std::uint32_t>(positive) >> kBinShift;
}
double lower_edge_of_bin(std::size_t bin) {
  return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bin << kBinShift)));
}

struct ChannelSums {
  float minimum = kInfinity, maximum = -kInfinity;
  double sum = 0, weight = 0;
  std::uint64_t nan = 0, infinite = 0, negative = 0;

  void take_row(const float* values, int stride, const float* weights, int width) {
    float low = minimum, high = maximum;
    double row_sum = 0, row_weight = 0;
    for (int x = 0; x < width; ++x, values += stride) {
      const float value = *values;
      if (weights[x] > 0) {
        if (std::isfinite(value)) {
          low = std::min(low, value);
          high = std::max(high, value);
          row_sum += static_cast<double>(weights[x]) * static_cast<double>(value);
          row_weight += static_cast<double>(weights[x]);
          negative += value < 0 ? 1 : 0;
        } else {
          ++(std::isnan(value) ? nan : infinite);
        }
      }
    }
    minimum = low;
    maximum = high;
    sum += row_sum;
    weight += row_weight;
  }

  void add(const ChannelSums& other) {
    minimum = std::min(minimum, other.minimum);
    maximum = std::max(maximum, other.maximum);
    sum += other.sum;
    weight += other.weight;
    nan += other.nan;
    infinite += other.infinite;
    negative += other.negative;
  }
};

struct LuminanceSums {
  float minimum = kInfinity, maximum = -kInfinity, smallest_positive = kInfinity;
  int brightest_row = 0, brightest_x = 0;
  double sum = 0, weight = 0, not_positive = 0;
  std::vector<double> histogram = std::vector<double>(kBins);

  void take(float value, float solid_angle, int row, int x) {
    if (!std::isfinite(value)) return;
    const double w = static_cast<double>(solid_angle);
    minimum = std::min(minimum, value);
    if (value > maximum) {
      maximum = value;
      brightest_row = row;
      brightest_x = x;
    }
    sum += w * static_cast<double>(value);
    weight += w;
    if (value > 0) {
      smallest_positive = std::min(smallest_positive, value);
      histogram[bin_of(value)] += w;
    } else {
      not_positive += w;
    }
  }

  void add(const LuminanceSums& other) {
    minimum = std::min(minimum, other.minimum);
    smallest_positive = std::min(smallest_positive, other.smallest_positive);
    if (other.maximum > maximum) {
      maximum = other.maximum;
      brightest_row = other.brightest_row;
      brightest_x = other.brightest_x;
    }
    sum += other.sum;
    weight += other.weight;
    not_positive += other.not_positive;
    for (std::size_t i = 0; i < kBins; ++i) histogram[i] += other.histogram[i];
  }

  double percentile(double percent) const {
    const double wanted = percent / 100 * weight;
    double below = not_positive;
    if (!(maximum > 0) || wanted < below) return 0;
    for (std::size_t bin = 0; bin < kBins; ++bin) {
      if (histogram[bin] > 0 && below + histogram[bin] >= wanted) {
        const double low = std::max(lower_edge_of_bin(bin), static_cast<double>(smallest_positive));
        const double high = std::min(lower_edge_of_bin(bin + 1), static_cast<double>(maximum));
        return low + (high - low) * (wanted - below) / histogram[bin];
      }
      below += histogram[bin];
    }
    return static_cast<double>(maximum);
  }
};

struct BandSums {
  std::uint64_t texels = 0;
  double weight = 0;
  std::vector<ChannelSums> channels;
  LuminanceSums luminance;
};

struct LightSums {
  Vec3d direction{0, 0, 0};
  double weight = 0, luminance = 0;
  std::vector<double> channels;
};

class Measurer {
 public:
  Measurer(const Map& map, const Monitor& monitor)
      : map_(map),
        monitor_(monitor),
        luminance_(map.channel_names),
        bands_(map.charts() * map.height()),
        row_maximum_(static_cast<std::size_t>(bands_.rows), -kInfinity) {}

  MapStatistics run() {
    const BandSums sums = add_up();
    // Texels together cover what the parameterization does.
    const double coverage = map_.parameterization.coverage();
    scale_ = sums.weight > 0 ? coverage / sums.weight : 0;
    MapStatistics result;
    result.texels = sums.texels;
    result.solid_angle = sums.texels > 0 ? coverage : 0;
    for (std::size_t c = 0; c < sums.channels.size(); ++c) {
      result.channels.push_back(channel(map_.channel_names[c], sums.channels[c]));
    }
    result.luminance = luminance(sums.luminance);
    if (sums.luminance.maximum > 0) result.light = light(sums.luminance, result.luminance.integral);
    return result;
  }

 private:
  const float* row_of(int row) const {
    return map_.level.chart(row / map_.height()).row(row % map_.height());
  }

  void solid_angles(int row, std::vector<float>& weights) const {
    weights.resize(static_cast<std::size_t>(map_.width()));
    texel_solid_angles(map_.parameterization, map_.width(), map_.height(), row / map_.height(),
                       row % map_.height(), weights.data());
  }

  BandSums add_up() {
    std::vector<BandSums> bands(static_cast<std::size_t>(bands_.count));
    parallel_for(
        bands_.count, [&](int i) { add_up_band(i, bands[static_cast<std::size_t>(i)]); }, monitor_);
    BandSums total = std::move(bands[0]);
    for (std::size_t i = 1; i < bands.size(); ++i) {
      total.texels += bands[i].texels;
      total.weight += bands[i].weight;
      for (std::size_t c = 0; c < total.channels.size(); ++c) total.channels[c].add(bands[i].channels[c]);
      total.luminance.add(bands[i].luminance);
    }
    return total;
  }

  void add_up_band(int band, BandSums& sums) {
    const int channels = map_.channels(), width = map_.width();
    sums.channels.resize(static_cast<std::size_t>(channels));
    std::vector<float> weights;
    for (int row = bands_.first(band); row < bands_.first(band + 1); ++row) {
      const float* texels = row_of(row);
      solid_angles(row, weights);
      for (int c = 0; c < channels; ++c) {
        sums.channels[static_cast<std::size_t>(c)].take_row(texels + c, channels, weights.data(), width);
      }
      float maximum = -kInfinity;
      for (int x = 0; x < width; ++x) {
        const float weight = weights[static_cast<std::size_t>(x)];
        if (!(weight > 0)) continue;
        const float value = luminance_(texels + static_cast<std::ptrdiff_t>(x) * channels);
        sums.luminance.take(value, weight, row, x);
        maximum = std::max(maximum, value);
        ++sums.texels;
        sums.weight += static_cast<double>(weight);
      }
      row_maximum_[static_cast<std::size_t>(row)] = maximum;
    }
  }

  ChannelStatistics channel(const std::string& name, const ChannelSums& sums) const {
    ChannelStatistics result;
    result.name = name;
    result.nan_texels = sums.nan;
    result.infinite_texels = sums.infinite;
    result.negative_texels = sums.negative;
    if (!(sums.weight > 0)) return result;
    result.minimum = static_cast<double>(sums.minimum);
    result.maximum = static_cast<double>(sums.maximum);
    result.mean = sums.sum / sums.weight;
    result.integral = sums.sum * scale_;
    return result;
  }

  LuminanceStatistics luminance(const LuminanceSums& sums) const {
    LuminanceStatistics result;
    if (!(sums.weight > 0)) return result;
    result.minimum = static_cast<double>(sums.minimum);
    result.maximum = static_cast<double>(sums.maximum);
    result.mean = sums.sum / sums.weight;
    result.integral = sums.sum * scale_;
    if (!(sums.maximum > 0)) return result;
    result.smallest_positive = static_cast<double>(sums.smallest_positive);
    result.percentile_1 = sums.percentile(1);
    result.percentile_50 = sums.percentile(50);
    result.percentile_99 = sums.percentile(99);
    result.percentile_99_9 = sums.percentile(99.9);
    result.dynamic_range = std::log2(result.maximum / result.smallest_positive);
    return result;
  }

  BrightestLight light(const LuminanceSums& sums, double whole) const {
    BrightestLight result;
    result.chart = sums.brightest_row / map_.height();
    result.x = sums.brightest_x;
    result.y = sums.brightest_row % map_.height();
    result.peak = static_cast<double>(sums.maximum);
    const Vec3d peak = map_.parameterization.to_sphere(result.chart, (result.x + 0.5) / map_.width(),
                                                       (result.y + 0.5) / map_.height());
    const Matrix3 to_world = transpose(map_.orientation);
    result.peak_direction = to_world * peak;

    std::vector<LightSums> bands(static_cast<std::size_t>(bands_.count));
    parallel_for(
        bands_.count,
        [&](int i) { add_up_light(i, peak, 0.5f * sums.maximum, bands[static_cast<std::size_t>(i)]); },
        {nullptr, monitor_.cancelled});
    LightSums total;
    total.channels.resize(static_cast<std::size_t>(map_.channels()));
    for (const LightSums& band : bands) {
      total.direction = total.direction + band.direction;
      total.weight += band.weight;
      total.luminance += band.luminance;
      for (std::size_t c = 0; c < total.channels.size(); ++c) total.channels[c] += band.channels[c];
    }
    if (!(total.weight > 0)) return result;
    result.direction = to_world * normalize(total.direction);
    result.solid_angle = total.weight * scale_;
    result.luminance = total.luminance / total.weight;
    for (const double sum : total.channels) result.radiance.push_back(sum / total.weight);
    result.share = whole > 0 ? total.luminance * scale_ / whole : 0;
    return result;
  }

  /// The texels of a band that have at least `half` luminance and lie within reach of `peak`.
  void add_up_light(int band, const Vec3d& peak, float half, LightSums& sums) const {
    constexpr int kBatch = 256;
    alignas(64) float u[kBatch], v[kBatch], dx[kBatch], dy[kBatch], dz[kBatch];
    const double reach = std::cos(kLightReach);
    const int channels = map_.channels();
    sums.channels.resize(static_cast<std::size_t>(channels));
    std::vector<float> weights;
    for (int row = bands_.first(band); row < bands_.first(band + 1); ++row) {
      if (!(row_maximum_[static_cast<std::size_t>(row)] >= half)) continue;
      solid_angles(row, weights);
      std::fill(std::begin(v), std::end(v), centre(row % map_.height(), map_.height()));
      for (int start = 0; start < map_.width(); start += kBatch) {
        const int count = std::min(kBatch, map_.width() - start);
        const float* texels = row_of(row) + static_cast<std::ptrdiff_t>(start) * channels;
        const auto bright = [&](int i) {
          const float value = luminance_(texels + i * channels);
          return value >= half && value < kInfinity && weights[static_cast<std::size_t>(start + i)] > 0;
        };
        int first = 0;
        while (first < count && !bright(first)) ++first;
        if (first == count) continue;
        for (int i = 0; i < kBatch; ++i) u[i] = centre(std::min(start + i, map_.width() - 1), map_.width());
        map_.parameterization.kernels().to_sphere(map_.parameterization.self(), row / map_.height(), u, v, dx,
                                                  dy, dz, static_cast<std::size_t>(count));
        for (int i = first; i < count; ++i) {
          const Vec3d d{static_cast<double>(dx[i]), static_cast<double>(dy[i]), static_cast<double>(dz[i])};
          if (!bright(i) || dot(d, peak) < reach) continue;
          const float* texel = texels + i * channels;
          const double weight = static_cast<double>(weights[static_cast<std::size_t>(start + i)]);
          const double energy = weight * static_cast<double>(luminance_(texel));
          sums.weight += weight;
          sums.luminance += energy;
          sums.direction = sums.direction + energy * d;
          for (int c = 0; c < channels; ++c) {
            const double value = static_cast<double>(texel[c]);
            if (std::isfinite(value)) sums.channels[static_cast<std::size_t>(c)] += weight * value;
          }
        }
      }
    }
  }

  static float centre(int texel, int size) {
    return (static_cast<float>(texel) + 0.5f) / static_cast<float>(size);
  }

  const Map& map_;
  const Monitor& monitor_;
  const TexelLuminance luminance_;
  const RowBands bands_;
  std::vector<float> row_maximum_;
  double scale_ = 0;
};

}  // namespace

MapStatistics measure(const Map& map, const Monitor& monitor) {
  return Measurer(map, monitor).run();
}

}  // namespace welkin
