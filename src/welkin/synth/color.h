#pragma once

#include <array>

namespace welkin::synth {

/// Linear sRGB in double.
struct Color {
  double r, g, b;
};

inline Color operator+(const Color& a, const Color& b) {
  return {a.r + b.r, a.g + b.g, a.b + b.b};
}
inline Color operator*(const Color& a, const Color& b) {
  return {a.r * b.r, a.g * b.g, a.b * b.b};
}
inline Color operator*(double s, const Color& a) {
  return {s * a.r, s * a.g, s * a.b};
}

/// a where t = 0, b where t = 1.
inline Color mix(const Color& a, const Color& b, double t) {
  return (1 - t) * a + t * b;
}

/// Relative luminance (ITU-R BT.709).
inline double luminance(const Color& c) {
  return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b;
}

inline std::array<float, 3> to_radiance(const Color& c) {
  return {static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b)};
}

}  // namespace welkin::synth
