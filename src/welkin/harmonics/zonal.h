#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/harmonics/harmonics.h"
#include "welkin/lobe/lobe.h"

/// @file
/// What works on spherical harmonics degree by degree: convolution with lobes, windows; what is symmetric in
/// them.
namespace welkin::harmonics {

/// A_l, by which irradiance E(n) = ∫ L max(0, n·l) dω has the harmonics A_l L_lm: π, 2π/3, π/4, 0, −π/24…
/// (Ramamoorthi & Hanrahan 2001, eq. 8), degrees 0 … degree. Exact.
WELKIN_API std::vector<double> irradiance_factors(int degree);

/// The lobe's zonal coefficients (lobe/zonal.h): the map filtered with it has the harmonics λ_l L_lm. Of
/// `lambert` they are A_l/π.
WELKIN_API std::vector<double> lobe_factors(const lobe::AnyLobe& lobe, int degree);

/// Each coefficient times the factor of its degree. Throws Error (bad_request) for fewer factors than
/// degrees.
WELKIN_API SphericalHarmonics convolved(const SphericalHarmonics& harmonics, std::span<const double> factors);

/// Factors that let high degrees fade, so that what a cut leaves of an edge rings less.
enum class Window {
  none,     ///< 1
  hann,     ///< (1 + cos(π l/n))/2
  lanczos,  ///< sin(π l/n)/(π l/n)
};
/// `none`, `hann`, `lanczos`. Throws Error (bad_request) for other names.
WELKIN_API Window window_from_name(std::string_view name);
/// The window's factors of degrees 0 … degree, with n = degree + 1, the first that is lost (Sloan 2008,
/// "Windowing").
WELKIN_API std::vector<double> window_factors(Window window, int degree);

/// Luminance: one channel Y, by the channels' names as in LuminanceStatistics.
WELKIN_API SphericalHarmonics luminance_of(const SphericalHarmonics& harmonics);

/// Degrees 0 and 1 of a channel, of radiance.
struct LinearPart {
  double mean = 0;           ///< over the sphere
  Vec3d direction{0, 1, 0};  ///< where most comes from; +Y where there is none
  /// |∫ L d dω| / ∫ L dω: 0 of light that is the same from opposite sides, 1 of a single direction; where
  /// nothing is negative never above 1. 0 of a channel whose mean is 0.
  double ratio = 0;
};
/// The linear part of a channel.
WELKIN_API LinearPart linear_part(const SphericalHarmonics& harmonics, int channel);

/// The function that is symmetric about an axis and nearest to another.
struct ZonalFit {
  Vec3d axis{0, 1, 0};  ///< the same for all channels
  /// coefficients[l·channels + c]: of Y_l0 with the axis as pole.
  std::vector<double> coefficients;
  double error = 0;  ///< RMS of the difference over RMS of the function, degrees up to the fit's
};
/// The best axis and zonal coefficients of degrees 0 … degree, no higher than the function's: Σ over channels
/// of squared differences is the least of all axes, to 1e-8 of a radian; found from all maxima of a grid of a
/// quarter of the shortest wave.
WELKIN_API ZonalFit fit_zonal(const SphericalHarmonics& harmonics, int degree);

}  // namespace welkin::harmonics
