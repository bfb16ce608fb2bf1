#include "welkin/lookup/gaussian_levels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "welkin/base/number_text.h"
#include "welkin/base/parallel.h"
#include "welkin/lookup/cone_reference.h"
#include "welkin/lookup/gaussian_blur.h"
#include "welkin/lookup/gaussian_kernels.h"
#include "welkin/lookup/gaussian_taps.h"
#include "welkin/lookup/padded_cube.h"
#include "welkin/prefilter/prefilter.h"
#include "welkin/sphere/custom.h"

namespace welkin {
namespace {

/// Chebyshev's nodes of two lie this far from the middle of an interval, in its half lengths.
constexpr double kNode = 0.70710678118654752;

/// Two σ² of an interval.
std::array<double, 2> nodes_of(double lowest, double highest) {
  const double middle = 0.5 * (lowest + highest), away = kNode * 0.5 * (highest - lowest);
  return {middle - away, middle + away};
}

/// `narrowest`: the least σ² of a level.
std::vector<ChannelScale> scales_of(const Map& map, double narrowest) {
  const std::size_t channels = static_cast<std::size_t>(map.channels());
  std::vector<double> sums(channels), sizes(channels);
  std::vector<float> least(channels, 0.0f), most(channels, 0.0f),
      solid_angle(static_cast<std::size_t>(map.width()));
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
          most[c] = std::max(most[c], std::fabs(value));
        }
      }
    }
  }
  if (!map.parameterization.whole_world()) whole = 4 * kPi;
  std::vector<ChannelScale> scales(channels);
  for (std::size_t c = 0; c < channels; ++c) {
    scales[c].mean = static_cast<float>(sums[c] / whole);
    scales[c].size = sizes[c] > 0 ? static_cast<float>(sizes[c] / whole) : 1;
    scales[c].contrast = most[c] / scales[c].size;
    // Halves hold up to 65504 times what a stored 1 is: a power of two times the mean, so that a constant map
    // is stored exactly. A level of σ² is nowhere brighter than all light in one place is there.
    scales[c].scale = scales[c].size;
    for (double largest = std::min(double{scales[c].contrast}, 2 / narrowest); largest > 16384; largest /= 2)
      scales[c].scale *= 2;
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
    interval.wider = static_cast<float>(nodes[1]);
    // At x²/2σ² = 2 + √2 the line between the two crosses the Gaussian.
    interval.flank = static_cast<float>(std::pow(nodes[1] / nodes[0], 1 + std::numbers::sqrt2));
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

/// Stores a pair of maps, whose values are channels from `first` on. Returns their largest |value| / size.
double store(FaceGrid& a, FaceGrid& b, const GaussianInterval& interval, int first,
             const std::vector<ChannelScale>& scales, std::uint16_t* values, const Monitor& monitor) {
  const std::size_t channels = scales.size();
  const std::size_t here = std::min<std::size_t>(3, channels - static_cast<std::size_t>(first));
  const int side = interval.size + 2, skip = a.margin() - 1;
  std::array<float, 4> inverse{};
  std::vector<float> largest(3);
  for (std::size_t c = 0; c < here; ++c) inverse[c] = 1 / scales[static_cast<std::size_t>(first) + c].scale;
  // Columns by strips, whose coefficients are still near when they are stored.
  constexpr int kStrip = 16;
  constexpr std::ptrdiff_t kTexel = FaceGrid::kPair;
  const GaussianKernels& kernels = gaussian_kernels();
  parallel_for(
      3,
      [&](int pair) {
        const int rows = a.side();
        for (FaceGrid* map : {&a, &b})
          kernels.to_spline(map->pair(pair), {rows, kTexel, rows, rows * kTexel});
        std::array<std::uint16_t, 8 * kStrip> halves;
        float most = 0;
        for (int start = skip; start < skip + side; start += kStrip) {
          const std::size_t width = static_cast<std::size_t>(std::min(kStrip, skip + side - start));
          for (FaceGrid* map : {&a, &b}) {
            kernels.to_spline(map->pair(pair) + start * kTexel,
                              {rows, rows * kTexel, static_cast<int>(width), kTexel});
          }
          for (int y = 0; y < 2 * side; ++y) {
            const int face = 2 * pair + y / side, row = y % side;
            most =
                std::max(most, kernels.to_halves(a.at(face, start, row + skip), b.at(face, start, row + skip),
                                                 inverse.data(), width, halves.data()));
            const std::int64_t texel =
                interval.first + (static_cast<std::int64_t>(face) * side + row) * side + start - skip;
            std::uint16_t* stored = values + static_cast<std::size_t>(texel) * 2 * channels + first;
            if (channels == 3) {
              for (std::size_t x = 0; x < width; ++x) std::memcpy(stored + 6 * x, &halves[8 * x], 12);
              continue;
            }
            for (std::size_t x = 0; x < width; ++x) {
              for (std::size_t i = 0; i < 2; ++i, stored += channels)
                std::copy_n(&halves[8 * x + 3 * i], here, stored);
            }
          }
        }
        largest[static_cast<std::size_t>(pair)] = most;
      },
      without_progress(monitor));
  double contrast = 0;
  for (std::size_t c = 0; c < here; ++c) {
    const ChannelScale& scale = scales[static_cast<std::size_t>(first) + c];
    contrast = std::max(contrast,
                        double{*std::max_element(largest.begin(), largest.end())} * scale.scale / scale.size);
  }
  return contrast;
}

/// Channels from `first` on of a map that is a PaddedCube of the grid's size.
void copy_channels(const Map& map, int first, FaceGrid& grid) {
  const int here = std::min(3, map.channels() - first);
  for (int face = 0; face < 6; ++face) {
    const ImageView<const float> texels = map.level.chart(face);
    for (int y = 0; y < grid.side(); ++y) {
      float* to = grid.at(face, 0, y);
      const float* from = texels.row(y) + first;
      for (int x = 0; x < grid.side(); ++x, to += FaceGrid::kPair, from += map.channels()) {
        for (int c = 0; c < 3; ++c) to[c] = c < here ? from[c] : 0;
        to[3] = 0;
      }
    }
  }
}

/// Of three channels from `first` on: 1 over the size of each; 0 for one that is not there.
std::array<float, 3> inverse_sizes(const std::vector<ChannelScale>& scales, int first) {
  std::array<float, 3> inverse{};
  const std::size_t from = static_cast<std::size_t>(first);
  for (std::size_t c = 0; c < 3 && from + c < scales.size(); ++c) inverse[c] = 1 / scales[from + c].size;
  return inverse;
}

/// How the narrow levels are made: from grids of masses.
struct BlurPlan {
  std::vector<GaussianBlur> blurs;       ///< of the first intervals
  std::vector<int> grids;                ///< of each, the level of the masses
  int size = 0, margin = 0, levels = 1;  ///< of the masses
};

BlurPlan plan_blurs(const GaussianLevels& levels, const GaussianQuality& quality) {
  double contrast = 1;
  for (const ChannelScale& scale : levels.scales) contrast = std::max(contrast, double{scale.contrast});
  BlurPlan plan;
  std::vector<double> widest;
  for (const GaussianInterval& interval : levels.intervals) {
    const double wider = double{interval.wider}, narrower = interval.node;
    if (std::sqrt(wider) > quality.handover * levels.texel) break;
    plan.blurs.push_back({interval.size,
                          PaddedCube::kMargin,
                          {narrower, wider},
                          std::min(contrast, 2 / narrower),
                          quality.blur_tail});
    widest.push_back((narrower < levels.texel * levels.texel ? quality.fine_ratio : quality.ratio) *
                     std::sqrt(narrower));
  }
  // Margins must not go far around the sphere: of small maps fewer levels, or none, are made so.
  for (; !plan.blurs.empty(); plan.blurs.pop_back(), widest.pop_back()) {
    const double finest = *std::min_element(widest.begin(), widest.end());
    plan.grids.clear();
    for (const double w : widest) plan.grids.push_back(static_cast<int>(std::log2(w / finest) + 1e-9));
    plan.levels = *std::max_element(plan.grids.begin(), plan.grids.end()) + 1;
    const int unit = 1 << (plan.levels - 1);
    const auto whole_units = [&](double texels) { return static_cast<int>(std::ceil(texels / unit)) * unit; };
    plan.size = whole_units(kPi / 2 / finest);
    plan.margin = 0;
    bool is_near = true;
    for (std::size_t k = 0; k < plan.blurs.size() && is_near; ++k) {
      const GaussianBlur& blur = plan.blurs[k];
      is_near = kPi / 4 * (1 + 2.0 * blur.margin / blur.size) +
                    blur.reach(blur.brightest) * std::sqrt(blur.variances[1]) <
                1.2;
      if (!is_near) break;
      plan.margin = std::max(
          plan.margin, whole_units((margin_needed(blur, plan.size >> plan.grids[k]) + 3) << plan.grids[k]));
      is_near = kPi / 4 * (1 + 2.0 * plan.margin / plan.size) < 1.35;
    }
    if (is_near) break;
  }
  return plan;
}

/// The levels from `first` on, by the pre-filter.
std::vector<Map> prefiltered(const Map& map, const GaussianLevels& levels, std::size_t first,
                             double tolerance, const Monitor& monitor) {
  std::vector<PrefilterLevel> lobes;
  for (std::size_t k = first; k < levels.intervals.size(); ++k) {
    const GaussianInterval& interval = levels.intervals[k];
    const int side = interval.size + 2 * PaddedCube::kMargin;
    for (const double variance : {double{interval.node}, double{interval.wider}}) {
      const double kappa = vmf_concentration(std::sqrt(variance));
      lobes.push_back({{side, side}, lobe::AnyLobe::make("vmf,kappa=" + number_text(kappa))});
    }
  }
  PrefilterOptions options;
  options.tolerance = tolerance;
  options.borders = false;
  const PrefilterPlan plan({map.parameterization, {map.width(), map.height()}, map.channels()},
                           sphere::make_parameterization<PaddedCube>(), std::move(lobes), options);
  return plan.run(map, monitor);
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
            .ratio = 0.6,
            .fine_ratio = 0.9,
            .handover = 3,
            .blur_tail = 0.03,
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
          .ratio = 0.9,
          .fine_ratio = 0.9,
          .handover = 4,
          .blur_tail = 0.1,
          .tail = 0.2,
          .tolerance = 2e-3};
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

  levels.scales = scales_of(map, levels.intervals[0].node);
  const BlurPlan plan = plan_blurs(levels, quality);
  const std::size_t fine = plan.blurs.size();
  // First: it is what finds values that can't be worked with.
  const std::vector<Map> wide = prefiltered(map, levels, fine, quality.tolerance, part_of(monitor, 0, 0.4));

  const std::size_t values = levels.texels * 2 * static_cast<std::size_t>(map.channels());
  levels.halves = LargeMemory(values * sizeof(std::uint16_t) + 64, LargeMemory::Contents::unset);
  std::uint16_t* halves = reinterpret_cast<std::uint16_t*>(levels.halves.data());
  std::fill_n(halves + values, 32, std::uint16_t{0});
  int largest = 0;
  for (const GaussianInterval& interval : levels.intervals) largest = std::max(largest, interval.size);
  FaceGrid pair[2];
  for (FaceGrid& grid : pair) grid = FaceGrid(largest, PaddedCube::kMargin, LargeMemory::Contents::unset);
  std::vector<double> contrasts(levels.intervals.size());
  for (int first = 0; first < map.channels(); first += 3) {
    std::optional<MassGrid> masses;
    std::vector<BrightTiles> bright;
    if (fine > 0) {
      masses.emplace(map, first, plan.size, plan.margin, plan.levels, without_progress(monitor));
      for (int k = 0; k < plan.levels; ++k)
        bright.emplace_back(masses->level(k), inverse_sizes(levels.scales, first));
    }
    for (std::size_t k = 0; k < levels.intervals.size(); ++k) {
      for (FaceGrid& grid : pair) grid.resize(levels.intervals[k].size, PaddedCube::kMargin);
      if (k < fine) {
        const int grid = plan.grids[k];
        run_blur(masses->level(grid), bright[static_cast<std::size_t>(grid)], plan.blurs[k], pair[0], pair[1],
                 without_progress(monitor));
      } else {
        for (std::size_t i = 0; i < 2; ++i) copy_channels(wide[2 * (k - fine) + i], first, pair[i]);
      }
      const double contrast =
          store(pair[0], pair[1], levels.intervals[k], first, levels.scales, halves, monitor);
      contrasts[k] = std::max(contrasts[k], contrast);
    }
  }
  for (std::size_t k = 0; k < levels.intervals.size(); ++k)
    levels.intervals[k].reach = GaussianTapRules::reach_for(contrasts[k], quality);
  return levels;
}

}  // namespace welkin
