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
