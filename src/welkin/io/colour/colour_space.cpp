#include "welkin/io/colour/colour_space.h"

#include <algorithm>
#include <cmath>

#include "welkin/base/error.h"

namespace welkin::io {
namespace {

Matrix3 inverse(const Matrix3& m) {
  const double d = determinant(m);
  if (!(std::fabs(d) > 1e-9)) throw Error(ErrorKind::bad_value, "its primaries lie on one line");
  Matrix3 result;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t r1 = (k + 1) % 3, r2 = (k + 2) % 3, c1 = (i + 1) % 3, c2 = (i + 2) % 3;
      result.rows[i][k] = (m.rows[r1][c1] * m.rows[r2][c2] - m.rows[r1][c2] * m.rows[r2][c1]) / d;
    }
  }
  return result;
}

/// XYZ of luminance 1.
Vec3d xyz_of(const double (&xy)[2]) {
  if (!(xy[1] > 1e-6) || !std::isfinite(xy[0] / xy[1]))
    throw Error(ErrorKind::bad_value, "its white has no luminance");
  return {xy[0] / xy[1], 1, (1 - xy[0] - xy[1]) / xy[1]};
}

/// Columns are the primaries, scaled so that R = G = B = 1 is white.
Matrix3 to_xyz(const Chromaticities& c) {
  const auto z = [](const double(&xy)[2]) { return 1 - xy[0] - xy[1]; };
  const Matrix3 primaries{{{{c.red[0], c.green[0], c.blue[0]},
                            {c.red[1], c.green[1], c.blue[1]},
                            {z(c.red), z(c.green), z(c.blue)}}}};
  const Vec3d scale = inverse(primaries) * xyz_of(c.white);
  // Else one of them would have negative light.
  if (!(scale.x > 0 && scale.y > 0 && scale.z > 0))
    throw Error(ErrorKind::bad_value, "its white lies outside its primaries");
  Matrix3 result = primaries;
  for (auto& row : result.rows) row = {row[0] * scale.x, row[1] * scale.y, row[2] * scale.z};
  return result;
}

/// XYZ under one white to XYZ under another.
Matrix3 adaptation(const double (&from)[2], const double (&to)[2]) {
  constexpr Matrix3 kCones{
      {{{0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}}}};
  const Vec3d a = kCones * xyz_of(from), b = kCones * xyz_of(to);
  if (!(a.x > 0 && a.y > 0 && a.z > 0)) throw Error(ErrorKind::bad_value, "its white is no light");
  const Matrix3 gains{{{{b.x / a.x, 0, 0}, {0, b.y / a.y, 0}, {0, 0, b.z / a.z}}}};
  return inverse(kCones) * gains * kCones;
}

double pq_to_linear(double stored) {
  constexpr double kM1 = 2610.0 / 16384, kM2 = 2523.0 / 4096 * 128, kC1 = 3424.0 / 4096,
                   kC2 = 2413.0 / 4096 * 32, kC3 = 2392.0 / 4096 * 32, kPeak = 10000;
  const double root = std::pow(stored, 1 / kM2);
  const double below = kC2 - kC3 * root;
  return kPeak / kDiffuseWhite * std::pow(std::max(root - kC1, 0.0) / std::max(below, 1e-9), 1 / kM1);
}

double hlg_to_linear(double stored) {
  constexpr double kA = 0.17883277, kB = 0.28466892, kC = 0.55991073;
  return stored <= 0.5 ? stored * stored / 3 : (std::exp((stored - kC) / kA) + kB) / 12;
}

double bt709_to_linear(double stored) {
  // The constants to more digits than BT.709 has, so that the pieces meet (BT.2020).
  constexpr double kAlpha = 1.09929682680944, kBeta = 0.018053968510807;
  return stored < 4.5 * kBeta ? stored / 4.5 : std::pow((stored + kAlpha - 1) / kAlpha, 1 / 0.45);
}

}  // namespace

Matrix3 to_bt709(const Chromaticities& primaries) {
  const Matrix3 to_rgb = inverse(to_xyz(kBt709));
  if (std::fabs(primaries.white[0] - kBt709.white[0]) < 1e-5 &&
      std::fabs(primaries.white[1] - kBt709.white[1]) < 1e-5)
    return to_rgb * to_xyz(primaries);
  return to_rgb * adaptation(primaries.white, kBt709.white) * to_xyz(primaries);
}

bool is_bt709(const Chromaticities& primaries) {
  const Matrix3 matrix = to_bt709(primaries);
  double largest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k)
      largest = std::max(largest, std::fabs(matrix.rows[i][k] - (i == k ? 1 : 0)));
  }
  return largest < 1e-4;
}

double to_linear(Curve curve, double gamma, double stored) {
  const double magnitude = std::fabs(stored);
  const auto of = [&] {
    switch (curve) {
      case Curve::gamma:
        return std::pow(magnitude, gamma);
      case Curve::bt709:
        return bt709_to_linear(magnitude);
      case Curve::pq:
        return pq_to_linear(magnitude);
      case Curve::hlg:
        return hlg_to_linear(magnitude);
      case Curve::none:
        break;
    }
    return magnitude;
  };
  return std::copysign(of(), stored);
}

double hlg_display_gain(double scene) {
  constexpr double kPeak = 1000, kSystemGamma = 1.2;
  return kPeak / kDiffuseWhite * std::pow(std::max(scene, 0.0), kSystemGamma - 1);
}

}  // namespace welkin::io
