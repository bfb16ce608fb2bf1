#include <array>

#include "welkin/math/angles.h"
#include "welkin/synth/color.h"
#include "welkin/synth/maps.h"

/// A clear sky: "A Practical Analytic Model for Daylight", Preetham, Shirley & Smits 1999, for the sky's
/// colour (their appendix A.2) and for the sunlight after the atmosphere's attenuation (A.1, without ozone,
/// mixed gases and water vapour, some percent). One unit is 10 kcd/m².
///
/// What the model leaves open: colours outside the gamut of sRGB have their negative components raised to 0;
/// the ground is an even diffuse plain under that sun and sky, fading into the horizon with distance.
namespace welkin::synth {
namespace {

/// Luminance and chromaticity (CIE 1931), each with Perez's five coefficients.
struct Perez {
  double a, b, c, d, e;

  /// Relative value at angle `zenith` from straight up and `sun` from the sun, radians.
  double operator()(double zenith, double sun) const {
    const double height = max(cos(zenith), 1e-4);
    return (1 + a * exp(b / height)) * (1 + c * exp(d * sun) + e * cos(sun) * cos(sun));
  }
};

/// Value at the zenith, and its distribution over the sky: value(θ, γ) = zenith · F(θ, γ) / F(0, θ_sun).
struct Distribution {
  Perez perez;
  double scale;
  double operator()(double zenith, double sun) const { return scale * perez(zenith, sun); }
};

using Cubics = std::array<std::array<double, 4>, 3>;

/// Chromaticity at the zenith: a cubic of the sun's zenith angle whose coefficients are quadratics of
/// turbidity.
double zenith_chromaticity(const Cubics& m, double t, double s) {
  const auto cubic = [&](std::size_t i) { return ((m[i][0] * s + m[i][1]) * s + m[i][2]) * s + m[i][3]; };
  return (cubic(0) * t + cubic(1)) * t + cubic(2);
}
constexpr Cubics kZenithX{{{0.00166, -0.00375, 0.00209, 0},
                           {-0.02903, 0.06377, -0.03202, 0.00394},
                           {0.11693, -0.21196, 0.06052, 0.25886}}};
constexpr Cubics kZenithY{{{0.00275, -0.00610, 0.00317, 0},
                           {-0.04214, 0.08970, -0.04153, 0.00516},
                           {0.15346, -0.26756, 0.06670, 0.26688}}};

/// Linear sRGB (D65) of luminance Y and chromaticity (x, y), IEC 61966-2-1.
Color color_of(double luminance, double x, double y) {
  const double big_x = x / y * luminance, big_z = (1 - x - y) / y * luminance;
  const Color c{3.2406 * big_x - 1.5372 * luminance - 0.4986 * big_z,
                -0.9689 * big_x + 1.8758 * luminance + 0.0415 * big_z,
                0.0557 * big_x - 0.2040 * luminance + 1.0570 * big_z};
  return {max(c.r, 0.0), max(c.g, 0.0), max(c.b, 0.0)};
}

class Sky {
 public:
  Sky(const Vec3d& sun, double turbidity) : sun_(sun) {
    const double t = turbidity;
    const double s = angle_between(sun, {0, 1, 0});
    const double chi = (4.0 / 9 - t / 120) * (kPi - 2 * s);
    // Tens of kcd/m².
    const double zenith = 0.1 * ((4.0453 * t - 4.9710) * tan(chi) - 0.2155 * t + 2.4192);
    const auto distribution = [&](const Perez& perez, double value) {
      return Distribution{perez, value / perez(0, s)};
    };
    luminance_ = distribution({0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251,
                               0.1206 * t - 2.5771, -0.0670 * t + 0.3703},
                              zenith);
    x_ = distribution({-0.0193 * t - 0.2592, -0.0665 * t + 0.0008, -0.0004 * t + 0.2125, -0.0641 * t - 0.8989,
                       -0.0033 * t + 0.0452},
                      zenith_chromaticity(kZenithX, t, s));
    y_ = distribution({-0.0167 * t - 0.2608, -0.0950 * t + 0.0092, -0.0079 * t + 0.2102, -0.0441 * t - 1.6537,
                       -0.0109 * t + 0.0529},
                      zenith_chromaticity(kZenithY, t, s));
  }

  /// At or above the horizon.
  Color operator()(const Vec3d& d) const {
    const double zenith = angle_between(d, {0, 1, 0}), sun = angle_between(d, sun_);
    return color_of(max(luminance_(zenith, sun), 0.0), x_(zenith, sun), y_(zenith, sun));
  }

 private:
  Vec3d sun_;
  Distribution luminance_{}, x_{}, y_{};
};

/// Irradiance of the sky on level ground: ∫ L cos θ dω over the upper hemisphere, midpoint rule (1e-3).
Color irradiance_of(const Sky& sky) {
  constexpr int kRings = 48, kSpokes = 96;
  Color sum{0, 0, 0};
  for (int i = 0; i < kRings; ++i) {
    // Rings of equal ∫ cos θ dω: sin² θ = (i + ½)/N.
    const double sine = std::sqrt((i + 0.5) / kRings), cosine = std::sqrt(1 - sine * sine);
    for (int j = 0; j < kSpokes; ++j) {
      const double turn = 2 * kPi * (j + 0.5) / kSpokes;
      sum = sum + sky({sine * std::sin(turn), cosine, sine * std::cos(turn)});
    }
  }
  return (kPi / (kRings * kSpokes)) * sum;
}

/// Irradiance across the sun's rays on the ground, in units of this map (sr × 10 kcd/m²): the solar
/// illuminance constant, 128 klx (IESNA 2000), through Rayleigh's and Ångström's scattering at the
/// wavelengths of the three primaries.
Color sunlight(double elevation, double turbidity) {
  constexpr double kOutside = 12.8;
  // Relative optical mass (Kasten 1966).
  const double mass = 1 / (sin(elevation * kDegree) + 0.15 * std::pow(elevation + 3.885, -1.253));
  const double beta = 0.04608 * turbidity - 0.04586;
  const auto through = [&](double micrometres) {
    return exp(-mass * (0.008735 * std::pow(micrometres, -4.08) + beta * std::pow(micrometres, -1.3)));
  };
  return kOutside * Color{through(0.610), through(0.550), through(0.465)};
}

}  // namespace

Radiance make_sky(const SynthOptions& options) {
  const double elevation = checked_option(options.elevation, {"sky", "elevation", 0, 90});
  const double azimuth = checked_option(options.azimuth, {"sky", "azimuth", -360, 360});
  const double turbidity = checked_option(options.turbidity, {"sky", "turbidity", 2, 10});
  const double albedo = checked_option(options.albedo, {"sky", "albedo", 0, 1});
  const double radius = option_or(options.angle, kSunDiameter, {"sky", "angle", 0.01, 30}) * kDegree / 2;
  const double scale = scale_option(options, "sky");

  const Vec3d sun = direction_at(azimuth, elevation);
  const Sky sky(sun, turbidity);
  const Color direct = sunlight(elevation, turbidity);
  // ω = 2π(1 − cos r) = 4π sin²(r/2).
  const double half_sine = sin(radius / 2);
  const Color disc = (1 / (4 * kPi * half_sine * half_sine)) * direct;
  // Level ground under a disc: ∫ cos dω = π sin² r × the sine of its elevation.
  const Color from_disc = (kPi * sin(radius) * sin(radius) * sun.y) * disc;
  const Color ground = (albedo / kPi) * (irradiance_of(sky) + from_disc);

  return [=](const Vec3d& d) {
    const double level = max(d.y, 0.0);
    const double around = max(sqrt(d.x * d.x + d.z * d.z), 1e-12);
    const double stretch = sqrt(1 - level * level) / around;
    Color color = sky({d.x * stretch, level, d.z * stretch});
    // Aerial perspective (Koschmieder 1924): the ground's share is e^(−distance), distance ∝ 1/sin of the
    // angle down.
    if (d.y < 0) return to_radiance(scale * mix(color, ground, exp(0.02 * (1 + 1 / d.y))));
    if (angle_between(d, sun) <= radius) color = color + disc;
    return to_radiance(scale * color);
  };
}

}  // namespace welkin::synth
