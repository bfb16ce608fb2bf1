#pragma once

#include <span>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/harmonics/extrema.h"
#include "welkin/harmonics/harmonics.h"

/// @file
/// Ringing, measured and removed.
namespace welkin::harmonics {

/// Whose factors are found.
enum class DeringChannels {
  each,      ///< each channel has its own
  together,  ///< one factor for all channels: colours keep their directions
};

/// What dering found.
struct Deringing {
  SphericalHarmonics harmonics;  ///< times the factors
  /// factors[channel][l], 0 … 1; 1 of degree 0.
  std::vector<std::vector<double>> factors;
  std::vector<Extremum> before;  ///< the least convolved value of each channel
  std::vector<Extremum> after;   ///< the same afterwards: not below 0
  double change = 0;             ///< RMS of the change of convolved values over their RMS
};

/// Multiplies degrees by factors 0 … 1 so that the function convolved with `zonal` (irradiance_factors, or a
/// lobe's) is nowhere negative, with the least change of it: of all such factors those whose mean square
/// change of the convolved function over the sphere is the least, to 1e-6 of it. The aim is Sloan's (2008,
/// "Stupid spherical harmonics tricks", and 2017, "Deringing spherical harmonics"); instead of one window
/// that widens until nothing is negative, each degree has its factor: a quadratic programme whose constraints
/// are the minima found so far (minimum_of). Degrees that the convolution removes stay as they are, as do
/// functions that aren't negative anywhere.
///
/// Throws Error: bad_value where a channel's mean isn't positive although the channel isn't 0 everywhere,
/// which no factors can mend; bad_request for fewer zonal coefficients than degrees.
WELKIN_API Deringing dering(const SphericalHarmonics& harmonics, std::span<const double> zonal,
                            DeringChannels channels = DeringChannels::each);

}  // namespace welkin::harmonics
