#include "welkin/harmonics/project.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "welkin/base/error.h"
#include "welkin/harmonics/longitude_rows.h"
#include "welkin/harmonics/texel_harmonics.h"
#include "welkin/harmonics/texel_quadrature.h"
#include "welkin/map/borders.h"
#include "welkin/map/luminance.h"

namespace welkin::harmonics {
namespace {

bool is_finite(std::span<const double> values) {
  return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

/// Says why the sums of a map aren't finite.
[[noreturn]] void throw_faults(const Map& map, const std::vector<int>& channels) {
  std::uint64_t faults = 0;
  std::string first;
  for (int chart = 0; chart < map.charts(); ++chart) {
    for (int y = 0; y < map.height(); ++y) {
      const std::vector<TexelKind> kinds =
          texel_kinds(map.parameterization, {map.width(), map.height()}, chart, y);
      const float* texel = map.level.chart(chart).row(y);
      for (int x = 0; x < map.width(); ++x, texel += map.channels()) {
        if (kinds[static_cast<std::size_t>(x)] == TexelKind::outside) continue;
        if (std::all_of(channels.begin(), channels.end(), [&](int c) { return std::isfinite(texel[c]); }))
          continue;
        if (faults++ == 0)
          first = "column " + std::to_string(x) + ", row " + std::to_string(y) +
                  (map.charts() > 1 ? " of chart " + std::to_string(chart) : "");
      }
    }
  }
  if (faults == 0) throw Error(ErrorKind::bad_value, "values are too large to add up: over 1e30");
  const std::uint64_t texels = static_cast<std::uint64_t>(map.charts()) *
                               static_cast<std::uint64_t>(map.width()) *
                               static_cast<std::uint64_t>(map.height());
  throw Error(ErrorKind::bad_value, std::to_string(faults) + " of " + std::to_string(texels) +
                                        (faults == 1 ? " texels is" : " texels are") +
                                        " NaN or infinite, the first in " + first);
}

SphericalHarmonics chosen(const SphericalHarmonics& all, const std::vector<int>& channels,
                          const std::vector<std::string>& names) {
  SphericalHarmonics result(all.degree(), static_cast<int>(channels.size()));
  for (std::size_t k = 0; k < channels.size(); ++k) {
    const std::size_t from = static_cast<std::size_t>(channels[k]);
    result.channel_names[k] = names[from];
    for (std::size_t i = 0; i < static_cast<std::size_t>(all.count()); ++i)
      result.values()[i * channels.size() + k] =
          all.values()[i * static_cast<std::size_t>(all.channels()) + from];
  }
  return result;
}

double dot(const SphericalHarmonics& a, const SphericalHarmonics& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.values().size(); ++i) sum += a.values()[i] * b.values()[i];
  return sum;
}

void add(SphericalHarmonics& to, double factor, const SphericalHarmonics& from) {
  for (std::size_t i = 0; i < to.values().size(); ++i) to.values()[i] += factor * from.values()[i];
}

/// Residual that ends the iteration, of the norm, and the most steps.
constexpr double kConverged = 1e-8;
constexpr int kSteps = 60;

/// The same of rounds over a map whose texels outside a disc fill_borders makes.
constexpr double kEnough = 5e-7;
constexpr int kRounds = 8;

/// The function whose texel means have the harmonics `wanted`, by conjugate gradients.
SphericalHarmonics corrected(const TexelHarmonics& texels, const SphericalHarmonics& wanted,
                             const Monitor& monitor) {
  SphericalHarmonics result = wanted, residual = wanted;
  const double enough = kConverged * kConverged * dot(wanted, wanted);
  add(residual, -1, texels.through_texels(result));
  SphericalHarmonics direction = residual;
  double square = dot(residual, residual);
  for (int step = 0; step < kSteps && square > enough; ++step) {
    if (monitor.cancelled && monitor.cancelled()) throw Cancelled();
    const SphericalHarmonics image = texels.through_texels(direction);
    const double length = square / dot(direction, image);
    add(result, length, direction);
    add(residual, -length, image);
    const double before = square;
    square = dot(residual, residual);
    direction *= square / before;
    add(direction, 1, residual);
  }
  return result;
}

}  // namespace

SphericalHarmonics project(const Map& map, int degree, const Monitor& monitor) {
  map.check();
  require(degree >= 0 && degree <= kMaxDegree, "spherical harmonics have degrees 0 to 96");
  const std::vector<int> channels = light_channels(map.channel_names);
  const auto texels = make_texel_harmonics(map, degree);
  const SphericalHarmonics all = texels->analyse(map, monitor);
  const SphericalHarmonics result = chosen(all, channels, map.channel_names);
  if (!is_finite(result.values())) throw_faults(map, channels);
  return rotated(result, transpose(texels->axes() * map.orientation));
}

int largest_degree(const sphere::AnyParameterization& parameterization, ChartSize size) {
  const MapFrame frame(parameterization, size);
  const double side = TexelQuadrature(frame.parameterization, size, 0).longest_side();
  int degree = std::clamp(static_cast<int>(0.8 * kPi / side), 0, kMaxDegree);
  if (longitudes_of(frame.parameterization)) degree = std::min(degree, (size.width - 1) / 2);
  return degree;
}

Map map_of(const SphericalHarmonics& harmonics, const sphere::AnyParameterization& parameterization,
           ChartSize size, const Matrix3& orientation, const Monitor& monitor) {
  require(is_orthonormal(orientation), "a map's orientation is a rotation or a reflection");
  Map map(parameterization, size.width, size.height, harmonics.channels());
  map.orientation = orientation;
  map.channel_names = harmonics.channel_names;
  const bool whole = map.parameterization.whole_world();
  if (whole) {
    const int largest = largest_degree(parameterization, size);
    if (harmonics.degree() > largest)
      throw Error(ErrorKind::bad_request, "texels of " + std::to_string(size.width) + "×" +
                                              std::to_string(size.height) + " " + parameterization.name() +
                                              " are too coarse for harmonics of degree " +
                                              std::to_string(harmonics.degree()) +
                                              ": they hold degrees up to " + std::to_string(largest));
  }
  const auto texels = make_texel_harmonics(map, harmonics.degree());
  if (whole) texels->keep_points();
  const SphericalHarmonics turned = rotated(harmonics, texels->axes() * orientation);
  const auto write = [&](const SphericalHarmonics& function) {
    texels->write_means(function, map, monitor);
    fill_borders(map.parameterization, map.level);
  };
  if (!whole) {
    write(turned);
    return map;
  }
  SphericalHarmonics wanted = turned;
  write(corrected(*texels, wanted, monitor));
  // On the rim of a disc, texels whose centre lies outside now hold what is beside them.
  for (int round = 0; round < kRounds && !map.parameterization.full_charts(); ++round) {
    SphericalHarmonics residual = turned;
    add(residual, -1, texels->analyse(map, monitor));
    if (residual.norm() <= kEnough * turned.norm()) break;
    wanted += residual;
    write(corrected(*texels, wanted, monitor));
  }
  return map;
}

}  // namespace welkin::harmonics
