#pragma once

namespace welkin::io {

/// CIE XYZ → linear RGB of the primaries and white (D65) of ITU-R BT.709 and sRGB, Y of white = 1; in place,
/// by the inverse of the matrix that their chromaticities define (IEC 61966-2-1, in more digits). No white
/// adaptation.
inline void xyz_to_rgb(float colour[3]) {
  const double x = colour[0], y = colour[1], z = colour[2];
  colour[0] = static_cast<float>(3.2409699419045226 * x - 1.5373831775700939 * y - 0.4986107602930034 * z);
  colour[1] = static_cast<float>(-0.9692436362808796 * x + 1.8759675015077202 * y + 0.0415550574071756 * z);
  colour[2] = static_cast<float>(0.0556300796969937 * x - 0.2039769588889765 * y + 1.0569715142428786 * z);
}

}  // namespace welkin::io
