#include "welkin/image/color_ramp.h"

#include <algorithm>
#include <cmath>

#include "welkin/math/scalar.h"

namespace welkin {
namespace {

/// Oklab to linear sRGB (Ottosson 2020), colours out of range clipped.
std::array<float, 3> from_oklab(double lightness, double a, double b) {
  const auto cube = [](double x) { return x * x * x; };
  const double l = cube(lightness + 0.3963377774 * a + 0.2158037573 * b);
  const double m = cube(lightness - 0.1055613458 * a - 0.0638541728 * b);
  const double s = cube(lightness - 0.0894841775 * a - 1.2914855480 * b);
  const auto clip = [](double x) { return static_cast<float>(std::clamp(x, 0.0, 1.0)); };
  return {clip(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
          clip(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
          clip(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
}

}  // namespace

std::array<float, 3> color_ramp(double t) {
  const double x = t > 0 ? std::min(t, 1.0) : 0.0;
  const double lightness = 0.24 + 0.68 * x;
  const double hue = (308 - 200 * x) * kPi / 180;
  const double chroma = 0.11 + 0.06 * x - 0.05 * std::sin(kPi * x);
  return from_oklab(lightness, chroma * std::cos(hue), chroma * std::sin(hue));
}

std::array<float, 3> neutral_color() {
  return from_oklab(0.6, 0, 0);
}

}  // namespace welkin
