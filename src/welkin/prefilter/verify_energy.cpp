#include "welkin/prefilter/verify_energy.h"

#include <algorithm>
#include <cmath>

#include "welkin/base/parallel.h"
#include "welkin/map/row_bands.h"
#include "welkin/map/texel_points.h"

namespace welkin::prefilter {
namespace {

constexpr int kMinRows = 256, kMaxRows = 512;

/// Sums value(texel's value)·Ω of each channel, in an order that depends on the size alone.
template <class Value>
std::vector<double> sum_texels(const Map& map, const Value& value) {
  const auto channels = static_cast<std::size_t>(map.channels());
  const RowBands bands(map.charts() * map.height());
  std::vector<std::vector<double>> sums(static_cast<std::size_t>(bands.count), std::vector<double>(channels));
  parallel_for(bands.count, [&](int band) {
    std::vector<double>& sum = sums[static_cast<std::size_t>(band)];
    for (int row = bands.first(band); row < bands.first(band + 1); ++row) {
      const int chart = row / map.height(), y = row % map.height();
      const std::vector<double> omega =
          summed_solid_angles(map.parameterization, {map.width(), map.height()}, chart, y);
      const float* texel = map.level.chart(chart).row(y);
      for (const double each : omega) {
        // Texels that aren't valid may hold anything.
        if (each > 0) {
          for (std::size_t c = 0; c < channels; ++c) {
            sum[c] += value(static_cast<double>(texel[c])) * each;
          }
        }
        texel += channels;
      }
    }
  });
  std::vector<double> total(channels);
  for (const std::vector<double>& sum : sums) {
    for (std::size_t c = 0; c < channels; ++c) total[c] += sum[c];
  }
  return total;
}

/// ∫ of a lat-long map with a row for each of Fejér's points.
std::vector<double> grid_integral(const Map& map) {
  const std::vector<double> weights = fejer_weights(map.height());
  const auto channels = static_cast<std::size_t>(map.channels());
  std::vector<double> total(channels);
  for (int j = 0; j < map.height(); ++j) {
    const double weight = weights[static_cast<std::size_t>(j)] * 2 * kPi / map.width();
    const float* texel = map.level.chart(0).row(j);
    for (int x = 0; x < map.width(); ++x) {
      for (std::size_t c = 0; c < channels; ++c) total[c] += weight * static_cast<double>(*texel++);
    }
  }
  return total;
}

}  // namespace

std::optional<int> energy_rows(const lobe::AnyLobe& lobe) {
  const double rows = 2 * std::ceil(8 / lobe.width());
  if (lobe.is_mirror() || rows > kMaxRows) return std::nullopt;
  return std::max(static_cast<int>(rows), kMinRows);
}

std::vector<double> fejer_weights(int rows) {
  std::vector<double> weights;
  for (int j = 0; j < rows; ++j) {
    double weight = 1;
    for (int k = 1; k <= rows / 2; ++k) {
      weight -= 2 * std::cos(2 * k * (j + 0.5) * kPi / rows) / (4.0 * k * k - 1);
    }
    weights.push_back(2 * weight / rows);
  }
  return weights;
}

Matrix3 energy_grid_orientation() {
  return rotation_from_yaw_pitch_roll(17, 29, 41);
}

std::vector<double> integral_of_texels(const Map& map) {
  return sum_texels(map, [](double value) { return value; });
}

std::vector<double> integral_of_magnitudes(const Map& map) {
  return sum_texels(map, [](double value) { return std::fabs(value); });
}

std::vector<std::optional<std::vector<double>>> integrals_of_levels(const Map& source,
                                                                    std::span<const lobe::AnyLobe> lobes,
                                                                    const VerifyOptions& options) {
  std::vector<std::optional<std::vector<double>>> integrals(lobes.size());
  const PrefilterShape shape{source.parameterization, {source.width(), source.height()}, source.channels()};
  PrefilterOptions prefilter = options.prefilter;
  prefilter.scale = LobeScale::average;
  prefilter.borders = false;

  // Lobes for a lat-long grid: all at once.
  prefilter.orientation = energy_grid_orientation();
  std::vector<PrefilterLevel> levels;
  std::vector<std::size_t> which;
  for (std::size_t i = 0; i < lobes.size(); ++i) {
    const std::optional<int> rows = energy_rows(lobes[i]);
    if (!rows) continue;
    levels.push_back({{2 * *rows, *rows}, lobes[i]});
    which.push_back(i);
  }
  if (!levels.empty()) {
    const PrefilterPlan plan(shape, sphere::AnyParameterization::make("latlong"), levels, prefilter);
    const std::vector<Map> maps = plan.run(source, {nullptr, options.monitor.cancelled});
    for (std::size_t k = 0; k < maps.size(); ++k) integrals[which[k]] = grid_integral(maps[k]);
  }

  // Narrower ones at the source's texels.
  if (!source.parameterization.whole_world()) return integrals;
  prefilter.orientation = source.orientation;
  for (std::size_t i = 0; i < lobes.size(); ++i) {
    if (integrals[i] || lobes[i].is_mirror()) continue;
    const PrefilterPlan plan(shape, source.parameterization, {{shape.size, lobes[i]}}, prefilter);
    const Map map = std::move(plan.run(source, {nullptr, options.monitor.cancelled}).front());
    // About a light at a pole there are few rows: texels times solid angles are a poor sum of what rows
    // resolve.
    const bool resolved =
        source.parameterization.traits().latlong_grid && lobes[i].width() > 3 * kPi / map.height();
    integrals[i] = resolved ? grid_integral(map) : integral_of_texels(map);
  }
  return integrals;
}

}  // namespace welkin::prefilter
