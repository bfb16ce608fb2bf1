#include "welkin/lookup/gaussian_levels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "welkin/base/number_text.h"
#include "welkin/base/parallel.h"
#include "welkin/lookup/gaussian_kernels.h"
#include "welkin/lookup/gaussian_taps.h"
#include "welkin/lookup/padded_cube.h"
#include "welkin/prefilter/prefilter.h"
#include "welkin/sphere/custom.h"

namespace welkin {
namespace {

/// coth κ − 1/κ, the mean cosine.
double mean_cosine(double kappa) {
  if (kappa < 1e-3) return kappa / 3;
  return 1 / std::tanh(kappa) - 1 / kappa;
}

/// Chebyshev's nodes of two lie this far from the middle of an interval, in its half lengths.
constexpr double kNode = 0.70710678118654752;

/// Two σ² of an interval.
std::array<double, 2> nodes_of(double lowest, double highest) {
  const double middle = 0.5 * (lowest + highest), away = kNode * 0.5 * (highest - lowest);
  return {middle - away, middle + away};
}

/// From samples to coefficients of the quadratic B-spline whose values at the texels are (c₋₁ + 6c₀ + c₁)/8
/// (Unser, Aldroubi & Eden 1993, part I; pole √8 − 3), along `count` values `step` apart, `lanes` of them
/// side by side. Past the ends samples are taken to stay as they are there.
void to_spline(float* values, int count, std::ptrdiff_t step, int lanes) {
  constexpr float kPole = -0.17157287525381f;
  constexpr float kStart = 8 / (1 - kPole), kTurn = -kPole / (1 - kPole);
  for (int i = 0; i < lanes; ++i) values[i] *= kStart;
  for (int k = 1; k < count; ++k) {
    float* here = values + k * step;
    const float* before = here - step;
    for (int i = 0; i < lanes; ++i) here[i] = 8 * here[i] + kPole * before[i];
  }
  float* last = values + (count - 1) * step;
  for (int i = 0; i < lanes; ++i) last[i] *= kTurn;
  for (int k = count - 2; k >= 0; --k) {
    float* here = values + k * step;
    const float* after = here + step;
    for (int i = 0; i < lanes; ++i) here[i] = kPole * (after[i] - here[i]);
  }
}

void to_spline(ImageView<float> face) {
  for (int y = 0; y < face.height; ++y) to_spline(face.row(y), face.width, face.channels, face.channels);
  to_spline(face.data, face.height, face.row_stride, face.width * face.channels);
}

std::vector<ChannelScale> scales_of(const Map& map) {
  const std::size_t channels = static_cast<std::size_t>(map.channels());
  std::vector<double> sums(channels), sizes(channels);
  std::vector<float> least(channels, 0.0f), solid_angle(static_cast<std::size_t>(map.width()));
  double whole = 0;
  for (int chart = 0; chart < map.charts(); ++chart) {
    const ImageView<const float> texels = map.level.chart(chart);
    for (int y = 0; y < map.height(); ++y) {
      texel_solid_angles(map.parameterization, map.width(), map.height(), chart, y, solid_angle.data());
      for (int x = 0; x < map.width(); ++x) {
        const double area = solid_angle[static_cast<std::size_t>(x)];
        whole += area;
        for (std::size_t c = 0; c < channels; ++c) {
          const float value = texels.at(x, y)[c];
          sums[c] += area * value;
          sizes[c] += area * std::fabs(value);
          least[c] = std::min(least[c], value);
        }
      }
    }
  }
  if (!map.parameterization.whole_world()) whole = 4 * kPi;
  std::vector<ChannelScale> scales(channels);
  for (std::size_t c = 0; c < channels; ++c) {
    scales[c].mean = static_cast<float>(sums[c] / whole);
    scales[c].scale = sizes[c] > 0 ? static_cast<float>(sizes[c] / whole) : 1;
    scales[c].positive = least[c] >= 0;
  }
  return scales;
}

/// Texels of a face's side for a σ².
int side_of(double variance, double density) {
  constexpr double kLeast = 16;
  return static_cast<int>(std::ceil(std::max(kLeast, density * kPi / 2 / std::sqrt(variance))));
}

std::int64_t texels_of(const GaussianInterval& interval) {
  return 6 * static_cast<std::int64_t>(interval.size + 2) * (interval.size + 2);
}

/// Adds intervals of one ratio, of about 2^step or less, from σ² `lowest` to `highest`.
void append_intervals(double lowest, double highest, double step, double density,
                      std::vector<GaussianInterval>& intervals) {
  const int count = std::max(1, static_cast<int>(std::ceil(std::log2(highest / lowest) / step - 0.01)));
  for (int k = 0; k < count; ++k) {
    const double low = lowest * std::pow(highest / lowest, static_cast<double>(k) / count);
    const double high = lowest * std::pow(highest / lowest, (k + 1.0) / count);
    const std::array<double, 2> nodes = nodes_of(low, high);
    GaussianInterval interval;
    interval.lowest = static_cast<float>(low);
    interval.node = static_cast<float>(nodes[0]);
    interval.per_variance = static_cast<float>(1 / (nodes[1] - nodes[0]));
    interval.size = side_of(low, density);
    interval.reach = 0;
    interval.first = intervals.empty() ? 0 : intervals.back().first + texels_of(intervals.back());
    intervals.push_back(interval);
  }
}

std::vector<GaussianInterval> intervals_of(double texel, const GaussianQuality& quality) {
  // As narrow as the pre-filter's lobes are, and as wide as leaves something to blur.
  const double whole = std::clamp(texel, 2e-4, 0.5), finest = quality.finest * whole;
  std::vector<GaussianInterval> intervals;
  append_intervals(finest * finest, whole * whole, quality.fine_step, quality.fine_density, intervals);
  append_intervals(whole * whole, kPi * kPi / 4, quality.step, quality.density, intervals);
  return intervals;
}

/// The largest |value| of each channel of each map.
std::vector<float> largest_of(const std::vector<Map>& maps) {
  const std::size_t channels = static_cast<std::size_t>(maps[0].channels());
  std::vector<float> largest(maps.size() * channels);
  parallel_for(static_cast<int>(maps.size()), [&](int k) {
    const Map& map = maps[static_cast<std::size_t>(k)];
    float* of = &largest[static_cast<std::size_t>(k) * channels];
    for (int face = 0; face < 6; ++face) {
      const ImageView<const float> texels = map.level.chart(face);
      for (int y = 0; y < texels.height; ++y) {
        const float* value = texels.row(y);
        for (int x = 0; x < texels.width; ++x) {
          for (std::size_t c = 0; c < channels; ++c, ++value) of[c] = std::max(of[c], std::fabs(*value));
        }
      }
    }
  });
  return largest;
}

/// A face of both maps of an interval, as pairs of halves.
void store_face(const GaussianInterval& interval, int face, ImageView<const float> a,
                ImageView<const float> b, const std::vector<ChannelScale>& scales, std::uint16_t* values) {
  const std::size_t channels = scales.size();
  const int side = interval.size + 2, skip = PaddedCube::kMargin - 1;
  std::vector<float> line(static_cast<std::size_t>(side) * 2 * channels), inverse(channels);
  for (std::size_t c = 0; c < channels; ++c) inverse[c] = 1 / scales[c].scale;
  for (int y = 0; y < side; ++y) {
    float* to = line.data();
    const float* from[2] = {a.at(skip, y + skip), b.at(skip, y + skip)};
    for (int x = 0; x < side; ++x) {
      for (const float*& values_of_map : from) {
        for (std::size_t c = 0; c < channels; ++c) *to++ = *values_of_map++ * inverse[c];
      }
    }
    const std::int64_t texel = interval.first + (static_cast<std::int64_t>(face) * side + y) * side;
    gaussian_kernels().to_halves(line.data(), values + static_cast<std::size_t>(texel) * 2 * channels,
                                 line.size());
  }
}

}  // namespace

GaussianQuality quality_of(GaussianAccuracy accuracy) {
  if (accuracy == GaussianAccuracy::permille) {
    return {.step = 0.25,
            .density = 1.6,
            .finest = 0.5,
            .fine_step = 0.5,
            .fine_density = 1,
            .spacing = 1.65,
            .hermite = 1,
            .tail = 0.05,
            .tolerance = 2e-4};
  }
  return {.step = 0.6667,
          .density = 1,
          .finest = 0.77,
          .fine_step = 1,
          .fine_density = 0.85,
          .spacing = 1.9,
          .hermite = 1.4,
          .tail = 0.2,
          .tolerance = 2e-3};
}

double gaussian_concentration(double variance) {
  const double wanted = std::exp(-variance);
  // Newton's steps from the limits for narrow and for wide lobes; the derivative is 1 − A² − 2A/κ.
  double kappa = variance < 1 ? 1 / variance + 0.5 : 3 * wanted;
  if (kappa > 1e6) return kappa;
  for (int i = 0; i < 50; ++i) {
    const double a = mean_cosine(kappa);
    const double slope = kappa < 1e-2 ? 1.0 / 3 : 1 - a * a - 2 * a / kappa;
    const double next = std::max(kappa / 4, kappa - (a - wanted) / slope);
    if (std::fabs(next - kappa) <= 1e-12 * kappa) return next;
    kappa = next;
  }
  return kappa;
}

GaussianLevels make_gaussian_levels(const Map& map, GaussianAccuracy accuracy, const Monitor& monitor) {
  map.check();
  const GaussianQuality quality = quality_of(accuracy);
  GaussianLevels levels;
  levels.channels = map.channels();
  levels.texel = std::sqrt(map.parameterization.coverage() / map.charts() / map.width() / map.height());
  levels.intervals = intervals_of(levels.texel, quality);
  levels.highest = static_cast<float>(kPi * kPi / 4);
  const std::int64_t texels = levels.intervals.back().first + texels_of(levels.intervals.back());
  if (texels > std::numeric_limits<std::int32_t>::max())
    throw Error(ErrorKind::too_large, "the levels of a stack of this map would have " +
                                          std::to_string(texels) +
                                          " texels; make the map smaller, or accept a larger error");
  levels.texels = static_cast<std::size_t>(texels);

  std::vector<PrefilterLevel> lobes;
  for (const GaussianInterval& interval : levels.intervals) {
    const int side = interval.size + 2 * PaddedCube::kMargin;
    for (const double variance :
         {double{interval.node}, double{interval.node} + 1 / double{interval.per_variance}}) {
      const double kappa = gaussian_concentration(variance);
      lobes.push_back({{side, side}, lobe::AnyLobe::make("vmf,kappa=" + number_text(kappa))});
    }
  }
  PrefilterOptions options;
  options.tolerance = quality.tolerance;
  options.borders = false;
  const PrefilterPlan plan({map.parameterization, {map.width(), map.height()}, map.channels()},
                           sphere::make_parameterization<PaddedCube>(), std::move(lobes), options);
  std::vector<Map> blurred = plan.run(map, part_of(monitor, 0, 0.8));

  levels.scales = scales_of(map);
  const std::vector<float> brightest = largest_of(blurred);
  for (std::size_t k = 0; k < levels.intervals.size(); ++k) {
    double contrast = 0;
    for (std::size_t c = 0; c < levels.scales.size(); ++c) {
      contrast =
          std::max(contrast, double{brightest[2 * k * levels.scales.size() + c]} / levels.scales[c].scale);
    }
    levels.intervals[k].reach = GaussianTapRules::reach_for(contrast, quality);
  }

  // Halves hold up to 65504 times what a stored 1 is: a power of two times the mean, so that a constant map
  // is stored exactly.
  for (int c = 0; c < map.channels(); ++c) {
    ChannelScale& scale = levels.scales[static_cast<std::size_t>(c)];
    const float largest = brightest[static_cast<std::size_t>(c)];
    while (largest > 8192 * scale.scale) scale.scale *= 2;
  }

  levels.halves =
      LargeMemory(levels.texels * 2 * static_cast<std::size_t>(map.channels()) * sizeof(std::uint16_t) + 64,
                  LargeMemory::Contents::zero);
  std::uint16_t* values = reinterpret_cast<std::uint16_t*>(levels.halves.data());
  parallel_for(
      static_cast<int>(levels.intervals.size()) * 6,
      [&](int job) {
        const std::size_t k = static_cast<std::size_t>(job / 6);
        const int face = job % 6;
        const ImageView<float> a = blurred[2 * k].level.chart(face), b = blurred[2 * k + 1].level.chart(face);
        to_spline(a);
        to_spline(b);
        store_face(levels.intervals[k], face, a, b, levels.scales, values);
      },
      part_of(monitor, 0.8, 1));
  return levels;
}

}  // namespace welkin
