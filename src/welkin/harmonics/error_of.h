#pragma once

#include <span>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/base/monitor.h"
#include "welkin/harmonics/extrema.h"
#include "welkin/harmonics/harmonics.h"
#include "welkin/map/map.h"

/// @file
/// How well a few harmonics stand for a map's light.
namespace welkin::harmonics {

/// The error of convolved values: irradiance, or what another lobe makes.
struct HarmonicsError {
  double relative_rmse = 0;  ///< root mean square over the sphere and all channels, over that of the exact
  std::vector<Extremum> minima;  ///< the least value of each channel of the approximation
  std::vector<double> means;     ///< of each channel of the approximation over the sphere
};

/// The error of an approximation against harmonics of a higher degree, both convolved with `zonal`, which has
/// a factor for each degree of the latter. By Parseval's theorem. Throws Error (mismatch) for other channels,
/// bad_request for too few factors.
WELKIN_API HarmonicsError error_of(const SphericalHarmonics& approximation, const SphericalHarmonics& exact,
                                   std::span<const double> zonal);

/// The most that degrees over those of `exact`, a map's harmonics, are of the relative RMSE, to which its
/// square adds up: what the map's square integral has that they have not, by Parseval's theorem, times the
/// larger of the last two factors of `zonal`, above which those that follow must not lie. Throws Error
/// (mismatch) for channels that the map lacks, bad_request for too few factors.
WELKIN_API double most_beyond(const Map& map, const SphericalHarmonics& exact, std::span<const double> zonal);

/// Harmonics of a map up to a high degree, to compare with: those of `known`, which project gave, and the
/// others. Of maps whose rows aren't latitudes these are found from a coarser level (make_pyramid) where they
/// would take long, which leaves about a hundredth of what they add uncertain. Throws as project.
WELKIN_API SphericalHarmonics reference_of(const Map& map, const SphericalHarmonics& known, int degree,
                                           const Monitor& monitor = {});

}  // namespace welkin::harmonics
