#include "welkin/harmonics/error_of.h"

#include <algorithm>
#include <cmath>

#include "welkin/base/error.h"
#include "welkin/harmonics/longitude_rows.h"
#include "welkin/harmonics/project.h"
#include "welkin/harmonics/zonal.h"
#include "welkin/map/borders.h"
#include "welkin/map/pyramid.h"

namespace welkin::harmonics {
namespace {

/// Texels times coefficients that are found within seconds.
constexpr double kMostWork = 3e8;

}  // namespace

HarmonicsError error_of(const SphericalHarmonics& approximation, const SphericalHarmonics& exact,
                        std::span<const double> zonal) {
  if (approximation.channels() != exact.channels())
    throw Error(ErrorKind::mismatch, "harmonics of other channels cannot be compared");
  const int degree = std::max(approximation.degree(), exact.degree());
  const SphericalHarmonics found = convolved(with_degree(approximation, degree), zonal),
                           wanted = convolved(with_degree(exact, degree), zonal);
  HarmonicsError error;
  double sum = 0;
  for (std::size_t i = 0; i < wanted.values().size(); ++i)
    sum += (found.values()[i] - wanted.values()[i]) * (found.values()[i] - wanted.values()[i]);
  if (sum > 0) error.relative_rmse = std::sqrt(sum) / wanted.norm();
  const SphericalHarmonics own = convolved(approximation, zonal);
  for (int c = 0; c < own.channels(); ++c) {
    error.minima.push_back(minimum_of(own, c));
    error.means.push_back(own.at(0, 0, c) / std::sqrt(4 * kPi));
  }
  return error;
}

double most_beyond(const Map& map, const SphericalHarmonics& exact, std::span<const double> zonal) {
  map.check();
  const double norm = convolved(exact, zonal).norm();
  std::vector<std::size_t> channels;
  for (const std::string& name : exact.channel_names) {
    const auto found = std::find(map.channel_names.begin(), map.channel_names.end(), name);
    if (found == map.channel_names.end())
      throw Error(ErrorKind::mismatch, "harmonics of other channels cannot be compared");
    channels.push_back(static_cast<std::size_t>(found - map.channel_names.begin()));
  }
  double square = 0;
  std::vector<float> solid_angles(static_cast<std::size_t>(map.width()));
  for (int chart = 0; chart < map.charts(); ++chart) {
    for (int y = 0; y < map.height(); ++y) {
      texel_solid_angles(map.parameterization, map.width(), map.height(), chart, y, solid_angles.data());
      const float* texel = map.level.chart(chart).row(y);
      for (const float solid_angle : solid_angles) {
        double sum = 0;
        for (const std::size_t c : channels)
          sum += static_cast<double>(texel[c]) * static_cast<double>(texel[c]);
        if (solid_angle > 0) square += static_cast<double>(solid_angle) * sum;
        texel += map.channels();
      }
    }
  }
  const auto degree = static_cast<std::size_t>(exact.degree());
  const double factor = std::max(std::fabs(zonal[degree]), degree > 0 ? std::fabs(zonal[degree - 1]) : 0);
  const double rest = std::max(0.0, square - exact.norm() * exact.norm());
  return rest > 0 && norm > 0 ? factor * std::sqrt(rest) / norm : 0;
}

SphericalHarmonics reference_of(const Map& map, const SphericalHarmonics& known, int degree,
                                const Monitor& monitor) {
  map.check();
  const double work = static_cast<double>(map.charts()) * map.width() * map.height() * count_of(degree);
  int levels = 0;
  if (!longitudes_of(map.parameterization)) {
    while (work / std::pow(4.0, levels) > kMostWork && levels < levels_below(map.width(), map.height()))
      ++levels;
  }
  const auto at_level = [&] {
    std::vector<Level> pyramid = make_pyramid(map, levels);
    Level& level = pyramid.back();
    Map coarse(map.parameterization, level.width(), level.height(), level.channels());
    coarse.level = std::move(level);
    coarse.channel_names = map.channel_names;
    coarse.orientation = map.orientation;
    return project(coarse, degree, monitor);
  };
  SphericalHarmonics result = levels > 0 ? at_level() : project(map, degree, monitor);
  const std::size_t exact = std::min(known.values().size(), result.values().size());
  std::copy_n(known.values().begin(), exact, result.values().begin());
  return result;
}

}  // namespace welkin::harmonics
