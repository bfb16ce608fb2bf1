#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/harmonics/harmonics.h"

/// @file
/// Spherical harmonics as engines hold them.
namespace welkin::harmonics {

/// How a program holds the harmonics of light: its scalings, orders and signs (docs/harmonics.md). Each of
/// its coefficients is a sum of a few of radiance's, with the factors of irradiance where it stores that.
struct Basis {
  std::string name;         ///< `filament`
  std::string description;  ///< one line: what is stored
  /// The convention (sphere/convention.h) whose look-up takes the world's directions to those along which the
  /// program evaluates; `native` where these are the world's own.
  std::string convention;
  int degree;  ///< that it has; kMaxDegree where it takes any
  /// What each coefficient is called, in the program's order; empty for `orthonormal`.
  std::vector<std::string> rows;
  std::string source;  ///< where that can be read: repository, file, function
};

/// All of them. The first is `orthonormal`: radiance's own coefficients, of any degree.
WELKIN_API const std::vector<Basis>& bases();

/// The basis of that name. Throws Error (bad_request) for one that bases() lacks; the nearest is suggested.
WELKIN_API const Basis& basis_from_name(std::string_view name);

/// From directions of the native world to those along which the program evaluates: that of its convention.
WELKIN_API Matrix3 world_of(const Basis& basis);

/// Coefficients in a basis: values[row·channels + c].
struct BasisCoefficients {
  std::string basis;                       ///< its name
  int degree = 0;                          ///< of orthonormal; what the basis has of the others
  std::vector<std::string> channel_names;  ///< one for each channel
  std::vector<double> values;              ///< of rows, channels side by side
};

/// Harmonics of radiance in a basis. `world` takes directions of the native world to those along which the
/// program evaluates; world_of unless something else is wanted. Degrees beyond those that the basis has are
/// left out, those that the harmonics lack are 0.
WELKIN_API BasisCoefficients to_basis(const SphericalHarmonics& radiance, const Basis& basis,
                                      const Matrix3& world);

/// The way back, exact but for rounding. Throws Error (mismatch) for another number of coefficients than the
/// basis has.
WELKIN_API SphericalHarmonics from_basis(const BasisCoefficients& coefficients, const Matrix3& world);

/// The constants of the shaders of `unity` and `unreal`, seven of four numbers (Sloan 2008, appendix A10):
/// SHAr SHAg SHAb SHBr SHBg SHBb SHC. Throws Error (bad_request) for other bases and unless there are three
/// channels.
WELKIN_API std::vector<double> packed_constants(const BasisCoefficients& coefficients);

}  // namespace welkin::harmonics
