#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "welkin/base/export.h"
#include "welkin/harmonics/bases.h"

/// @file
/// Coefficients as text.
namespace welkin::harmonics {

/// What a file of coefficients holds (docs/harmonics.md).
struct CoefficientsFile {
  BasisCoefficients coefficients;  ///< in a basis
  std::string of = "radiance";     ///< `radiance`, `irradiance`, or a lobe's spec that it was averaged with
  std::string convention = "native";  ///< the world along whose look-up directions it is evaluated
};

/// How they are written.
enum class CoefficientsFormat {
  json,      ///< {"order": 2, "basis": "orthonormal", "coefficients": [[r, g, b], …]}
  csv,       ///< a line for each coefficient
  c_header,  ///< an array; of `unity` and `unreal` also the shader's constants
  filament,  ///< cmgen's text, of the basis `filament` alone
};

/// By extension or name: `json`, `csv`, `h`, `txt` or `filament`. Throws Error (bad_request) for others.
WELKIN_API CoefficientsFormat coefficients_format(std::string_view name);

/// Whether a path ends in one of these extensions, so that it names coefficients and no picture.
WELKIN_API bool is_coefficients_path(std::string_view path);

/// The text of a file, ending with a line break. Numbers read back as the same doubles, in Filament's text to
/// 15 decimals. Throws Error (bad_request) for Filament's text of another basis, or of other than three
/// channels.
WELKIN_API std::string coefficients_text(const CoefficientsFile& file, CoefficientsFormat format);

/// JSON, CSV or Filament's text, told apart by how it begins. Of JSON, `coefficients` must be there; `order`
/// follows from their count, `basis` is orthonormal, `of` radiance and `convention` the basis's own unless
/// they say otherwise; other members are passed over. `name` is for messages. Throws Error (damaged: no such
/// text; mismatch: a count that isn't the order's or the basis's; bad_request: a basis or a convention that
/// there isn't; bad_value: not finite; too_large: over 64 MiB, or an order over kMaxDegree).
WELKIN_API CoefficientsFile parse_coefficients(std::string_view text, const std::string& name);

/// The same of a file. Throws Error that names it.
WELKIN_API CoefficientsFile read_coefficients(const std::string& path);

/// The harmonics that it holds, of the native world; of irradiance or of a filtered map where `of` says so.
WELKIN_API SphericalHarmonics harmonics_of(const CoefficientsFile& file);

}  // namespace welkin::harmonics
