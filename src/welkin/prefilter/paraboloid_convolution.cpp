#include "welkin/prefilter/paraboloid_convolution.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "welkin/base/error.h"
#include "welkin/base/parallel.h"
#include "welkin/filter/resample.h"
#include "welkin/filter/sampler.h"
#include "welkin/map/borders.h"

namespace welkin {
namespace {

/// The largest angle up to π/2 at which the lobe weighs at least `part` of its largest weight.
double angle_of_part(const lobe::AnyLobe& lobe, double part) {
  constexpr int kSteps = 4096;
  // 1 − cos θ, without cancellation.
  const auto weight = [&](double angle) {
    const double sine = std::sin(angle / 2);
    return lobe.weight(2 * sine * sine);
  };
  // Steps that are the smaller the nearer the axis, for lobes of any width.
  const auto angle_at = [](int k) { return kPi / 2 * std::pow(static_cast<double>(k) / kSteps, 3); };
  double largest = 0;
  for (int k = 0; k <= kSteps; ++k) largest = std::max(largest, weight(angle_at(k)));
  int last = kSteps;
  while (last > 0 && weight(angle_at(last)) < part * largest) --last;
  if (last == kSteps) return kPi / 2;
  double inside = angle_at(last), outside = angle_at(last + 1);
  for (int i = 0; i < 60; ++i) {
    const double middle = (inside + outside) / 2;
    (weight(middle) >= part * largest ? inside : outside) = middle;
  }
  return inside;
}

ParaboloidFilter filter_of(double diameter, int largest) {
  ParaboloidFilter filter;
  // A hair below an even number is that number.
  filter.diameter = std::max(2, 2 * static_cast<int>(std::ceil(diameter / 2 - 1e-9)));
  while (filter.diameter > largest * filter.shrink) filter.shrink *= 2;
  return filter;
}

/// Angles that radii on a face stand for, rim 1.
double angle_from_centre(double radius) {
  return 2 * std::atan(radius);
}
double angle_from_rim(double radius) {
  return kPi / 2 - 2 * std::atan(1 - radius);
}

/// The weights of a filter: 2·reach + 1 squared, row by row, of sum 1.
struct Taps {
  int reach;
  std::vector<float> weights;
};

template <class AngleOf>
Taps taps_of(const lobe::AnyLobe& lobe, double end, const ParaboloidFilter& filter, int face,
             const AngleOf& angle_of) {
  Taps taps{filter.diameter / 2 / filter.shrink, {}};
  const double step = 2.0 * filter.shrink / face;
  double sum = 0;
  std::vector<double> weights;
  for (int j = -taps.reach; j <= taps.reach; ++j) {
    for (int i = -taps.reach; i <= taps.reach; ++i) {
      const double radius = step * std::hypot(i, j), angle = angle_of(radius);
      const double sine = std::sin(angle / 2);
      weights.push_back(angle <= end || radius == 0 ? lobe.weight(2 * sine * sine) : 0);
      sum += weights.back();
    }
  }
  // A lobe that is 0 at its axis, and narrower than a texel.
  if (!(sum > 0)) weights[weights.size() / 2] = sum = 1;
  for (const double weight : weights) taps.weights.push_back(static_cast<float>(weight / sum));
  return taps;
}

/// A face with its border, shrunk.
class ShrunkFace {
 public:
  ShrunkFace(const Map& source, int chart, int shrink, int border, const Monitor& monitor)
      : source_(source),
        sampler_(Sampler::borrow(source)),
        chart_(chart),
        shrink_(shrink),
        border_(border),
        side_((source.width() + 2 * border + shrink - 1) / shrink),
        image_(side_, side_, source.channels()) {
    parallel_for(
        side_, [&](int row) { make_row(row); }, monitor);
  }

  /// Convolved; without the texels that the filter reaches past the border of.
  Image convolved(const Taps& taps, const Monitor& monitor) const {
    Image result(side_, side_, image_.channels());
    const int channels = image_.channels(), first = taps.reach, last = side_ - taps.reach;
    parallel_for(
        std::max(0, last - first),
        [&](int i) {
          const int y = first + i;
          for (int x = first; x < last; ++x) {
            const float* weight = taps.weights.data();
            float* out = result.at(x, y);
            for (int b = -taps.reach; b <= taps.reach; ++b) {
              for (int a = -taps.reach; a <= taps.reach; ++a, ++weight) {
                if (*weight == 0) continue;
                const float* in = image_.at(x + a, y + b);
                for (int c = 0; c < channels; ++c) out[c] += *weight * in[c];
              }
            }
          }
        },
        monitor);
    return result;
  }

 private:
  /// The mean over squares of texels: what the levels of a mip pyramid hold.
  void make_row(int row) {
    const int channels = source_.channels(), width = side_ * shrink_;
    std::vector<float> texels(static_cast<std::size_t>(width * channels));
    const float share = 1.0f / (static_cast<float>(shrink_) * static_cast<float>(shrink_));
    for (int j = 0; j < shrink_; ++j) {
      read_row(row * shrink_ + j - border_, texels);
      for (int x = 0; x < width; ++x) {
        float* out = image_.at(x / shrink_, row);
        for (int c = 0; c < channels; ++c)
          out[c] += share * texels[static_cast<std::size_t>(x * channels + c)];
      }
    }
  }

  /// A row of the face at its own resolution, from the border's first texel on: its own texels in the disc,
  /// and outside what the other half of the world has there.
  void read_row(int y, std::vector<float>& out) const {
    const auto& p = source_.parameterization;
    const std::size_t channels = static_cast<std::size_t>(source_.channels());
    const Matrix3 to_world = transpose(source_.orientation);
    const int face = source_.width();
    const double v = (y + 0.5) / face;
    std::vector<Vec3d> directions;
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < out.size() / channels; ++i) {
      const int x = static_cast<int>(i) - border_;
      const double u = (x + 0.5) / face;
      if (x >= 0 && x < face && y >= 0 && y < face && p.valid(chart_, u, v)) {
        std::copy_n(source_.level.chart(chart_).at(x, y), channels, &out[i * channels]);
      } else {
        directions.push_back(to_world * p.to_sphere(chart_, u, v));
        places.push_back(i);
      }
    }
    std::vector<float> values(directions.size() * channels);
    sampler_.look_up(directions, values);
    for (std::size_t k = 0; k < places.size(); ++k)
      std::copy_n(&values[k * channels], channels, &out[places[k] * channels]);
  }

  const Map& source_;
  Sampler sampler_;
  int chart_, shrink_, border_, side_;
  Image image_;
};

/// A face convolved with one filter, read between its texels.
class FilteredFace {
 public:
  FilteredFace(const Map& source, int chart, const ParaboloidFilter& filter, const Taps& taps,
               const Monitor& monitor)
      : face_(source.width()),
        shrink_(filter.shrink),
        // As far as the filter reaches from the edge, and a texel to interpolate with.
        border_(filter.shrink * (filter.diameter / 2 / filter.shrink + 2)),
        image_(ShrunkFace(source, chart, shrink_, border_, part_of(monitor, 0, 0.5))
                   .convolved(taps, part_of(monitor, 0.5, 1))) {}

  /// Bilinear.
  void add(double u, double v, float share, float* out) const {
    const double x = (u * face_ + border_) / shrink_ - 0.5, y = (v * face_ + border_) / shrink_ - 0.5;
    const double left = std::floor(x), top = std::floor(y);
    const float a = static_cast<float>(x - left), b = static_cast<float>(y - top);
    const float weights[4] = {(1 - a) * (1 - b), a * (1 - b), (1 - a) * b, a * b};
    for (int k = 0; k < 4; ++k) {
      const float* texel = image_.at(static_cast<int>(left) + k % 2, static_cast<int>(top) + k / 2);
      for (int c = 0; c < image_.channels(); ++c) out[c] += share * weights[k] * texel[c];
    }
  }

 private:
  int face_, shrink_, border_;
  Image image_;
};

void check(const Map& source, ChartSize size) {
  source.check();
  if (source.parameterization.name() != "paraboloid" || source.width() != source.height()) {
    throw Error(ErrorKind::mismatch,
                "paraboloid convolution: it filters paraboloid maps with square faces, not " +
                    source.parameterization.spec() + " of " + std::to_string(source.width()) + "x" +
                    std::to_string(source.height()) + "; convert the map first");
  }
  require(size.width >= 1 && size.width == size.height, "paraboloid convolution: faces are square");
}

}  // namespace

ParaboloidFilters paraboloid_filters(const lobe::AnyLobe& lobe, int face,
                                     const ParaboloidConvolutionOptions& options) {
  require(options.clamp > 0 && options.clamp < 1,
          "paraboloid convolution: lobes are clamped above 0 and below 1");
  require(options.largest_filter >= 3 && options.largest_filter <= 1024,
          "paraboloid convolution: filters have at most 3 to 1024 texels on a side");
  require(face >= 1, "paraboloid convolution: a face has at least one texel");
  ParaboloidFilters filters;
  if (lobe.is_mirror()) return filters;
  filters.angle = angle_of_part(lobe, options.clamp);
  filters.small = filter_of(face * std::tan(filters.angle / 2), options.largest_filter);
  filters.large = filter_of(face * (1 - std::tan(kPi / 4 - filters.angle / 2)), options.largest_filter);
  return filters;
}

Map convolve_paraboloid(const Map& source, const lobe::AnyLobe& lobe, ChartSize size,
                        const ParaboloidConvolutionOptions& options, const Monitor& monitor) {
  check(source, size);
  const int face = source.width();
  const ParaboloidFilters filters = paraboloid_filters(lobe, face, options);
  Map result(source.parameterization, size.width, size.height, source.channels());
  result.channel_names = source.channel_names;
  result.orientation = source.orientation;
  if (lobe.is_mirror()) {
    ResampleOptions resampling;
    resampling.monitor = monitor;
    resample(source, result, resampling);
    return result;
  }
  const Taps small = taps_of(lobe, filters.angle, filters.small, face, angle_from_centre);
  const Taps large = taps_of(lobe, filters.angle, filters.large, face, angle_from_rim);
  for (int chart = 0; chart < result.charts(); ++chart) {
    const double begin = chart / 2.0;
    const FilteredFace s(source, chart, filters.small, small, part_of(monitor, begin, begin + 0.2));
    const FilteredFace l(source, chart, filters.large, large, part_of(monitor, begin + 0.2, begin + 0.4));
    parallel_for(
        size.height,
        [&](int y) {
          for (int x = 0; x < size.width; ++x) {
            const double u = (x + 0.5) / size.width, v = (y + 0.5) / size.height;
            // Blending by alpha ends at 1, in the corners.
            const double d2 = std::min(1.0, 4 * ((u - 0.5) * (u - 0.5) + (v - 0.5) * (v - 0.5)));
            float* out = result.level.chart(chart).at(x, y);
            s.add(u, v, static_cast<float>(1 - d2), out);
            l.add(u, v, static_cast<float>(d2), out);
          }
        },
        part_of(monitor, begin + 0.4, begin + 0.5));
  }
  fill_borders(result);
  return result;
}

double circle_distortion(double radius, double distance) {
  require(radius > 0 && distance >= 0, "a circle has a radius above 0, at a distance of at least 0");
  const double outer = std::atan(distance + radius) - std::atan(distance);
  const double inner = std::atan(distance) - std::atan(distance - radius);
  return (inner - outer) / (inner + outer);
}

}  // namespace welkin
