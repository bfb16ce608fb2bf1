#pragma once

#include <cstdint>

/// ASTC's colour endpoint modes. Internal to texture. Source: Khronos Data Format Specification 1.3, section
/// 23.14.
namespace welkin::texture::astc {

inline constexpr int kEndpointModes = 16;

/// Values that a mode's pair of endpoints is stored in.
constexpr int values_of_mode(int mode) {
  return 2 * (mode / 4 + 1);
}

/// Two colours of R G B A, of 16 bits between which texels are interpolated.
struct Endpoints {
  int colour[2][4];
  bool hdr;        ///< R G B are logarithms of 12 bits, shifted by 4; else 0 … 65535 for 0 … 1
  bool hdr_alpha;  ///< the same of A
};

/// Of the values after unquantization, 0 … 255.
Endpoints endpoints_of(int mode, const std::uint8_t* values);

/// R G B of HDR mode 7 and of HDR mode 11, of 12 bits: the specification's e0 and e1.
/// @{
void decode_base_and_scale(const std::uint8_t* values, int (*ends)[3]);
void decode_direct(const std::uint8_t* values, int (*ends)[3]);
/// @}

/// Of HDR mode 11, by its mode bits: bits of the fields and how far they are shifted.
struct DirectMode {
  int a, b, c, d, shift;
};
inline constexpr DirectMode kDirectModes[8] = {{9, 7, 6, 7, 3},  {9, 8, 6, 6, 3},  {10, 6, 7, 7, 2},
                                               {10, 7, 7, 6, 2}, {11, 8, 6, 5, 1}, {11, 6, 8, 6, 1},
                                               {12, 7, 7, 5, 0}, {12, 6, 7, 6, 0}};

/// The same of HDR mode 7: the largest channel, the difference of both others from it, and the scale. In the
/// last mode channels are stored as they are.
struct ScaleMode {
  int largest, other, scale, shift;
};
inline constexpr ScaleMode kScaleModes[6] = {{11, 5, 7, 1}, {11, 6, 5, 1}, {10, 5, 8, 2},
                                             {9, 6, 7, 3},  {8, 7, 6, 4},  {7, 7, 7, 5}};

}  // namespace welkin::texture::astc
