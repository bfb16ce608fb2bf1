#pragma once

#include "welkin/io/declared.h"
#include "welkin/math/rotation.h"

/// Primaries and transfer functions of files, taken to linear BT.709, which maps hold.
namespace welkin::io {

/// ITU-R BT.709-6: sRGB's primaries and white D65.
inline constexpr Chromaticities kBt709{{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, {0.3127, 0.3290}};

/// Linear R G B of these primaries to linear R G B of BT.709, by CIE XYZ; white stays white, by Bradford's
/// adaptation (Lam 1985) where the whites differ. Throws Error (bad_value) for primaries on one line, and
/// whites outside them or without light.
Matrix3 to_bt709(const Chromaticities& primaries);

/// Whether to_bt709 changes no value by a part in 10⁴.
bool is_bt709(const Chromaticities& primaries);

/// Luminance of diffuse white, cd/m²: what 1 stands for in pictures of absolute luminance (ITU-R BT.2408).
inline constexpr double kDiffuseWhite = 203;

/// What a stored value is in linear light. PQ (SMPTE ST 2084): cd/m² over kDiffuseWhite. HLG (ITU-R BT.2100):
/// scene light in [0, 1], to which hlg_display_gain is still to be applied. Odd about 0.
double to_linear(Curve curve, double gamma, double stored);

/// What the R G B of HLG's scene light are multiplied by for the display of 1000 cd/m² that BT.2100 refers
/// to, over kDiffuseWhite: that of their luminance `scene`, by BT.2020's weights.
double hlg_display_gain(double scene);
inline constexpr double kHlgLuminance[3] = {0.2627, 0.6780, 0.0593};

}  // namespace welkin::io
