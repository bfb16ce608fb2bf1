#include "welkin/math/angles.h"
#include "welkin/synth/area_light.h"
#include "welkin/synth/color.h"
#include "welkin/synth/maps.h"

/// An empty room in metres, seen from its centre: red wall on +X, green on −X, a window in +Z, ochre on −Z,
/// and a lamp panel in the ceiling. A convex room casts no shadows, so that the direct light of panel and
/// window is exact; later bounces are taken as even everywhere, as in an integrating sphere.
namespace welkin::synth {
namespace {

constexpr Vec3d kHalf{2.4, 1.4, 3.0};

const AreaLight kPanel{{0, kHalf.y, 1.0}, {1, 0, 0}, {0, 0, 1}, {0, -1, 0}, 0.6, 0.45};
const AreaLight kWindow{{0, 0.1, kHalf.z}, {-1, 0, 0}, {0, 1, 0}, {0, 0, -1}, 1.3, 0.80};
constexpr Color kPanelRadiance{50, 46, 40};

constexpr Color kRed{0.52, 0.045, 0.035}, kGreen{0.10, 0.34, 0.075}, kCream{0.68, 0.64, 0.54};
constexpr Color kOchre{0.55, 0.30, 0.07}, kWhite{0.75, 0.75, 0.73};
constexpr Color kTileLight{0.60, 0.56, 0.48}, kTileDark{0.075, 0.085, 0.10}, kSkirting{0.12, 0.09, 0.07};

/// Sky behind the window at height y ∈ [−1, 1] of it: pale below, blue above.
Color window_sky(double y) {
  return mix({5.2, 6.2, 7.4}, {1.5, 3.2, 7.6}, 0.5 + 0.5 * y);
}
constexpr Color kWindowMean{3.35, 4.7, 7.5};

/// Frame of the window, and its bars: true on wood.
bool window_wood(double x, double y) {
  constexpr double kBar = 0.035, kFrame = 0.07;  // metres
  const double across = abs(x) * kWindow.half_width, up = abs(y) * kWindow.half_height;
  return across > kWindow.half_width - kFrame || up > kWindow.half_height - kFrame || across < kBar ||
         abs(y * kWindow.half_height - 0.25) < kBar;
}

struct Surface {
  Vec3d point, normal;
  Color albedo;
};

/// What the ray from the centre along d meets.
Surface surface_along(const Vec3d& d) {
  const double tx = kHalf.x / max(abs(d.x), 1e-12), ty = kHalf.y / max(abs(d.y), 1e-12);
  const double tz = kHalf.z / max(abs(d.z), 1e-12);
  const Vec3d point = min(tx, min(ty, tz)) * d;
  if (ty <= tx && ty <= tz) {
    if (d.y > 0) return {point, {0, -1, 0}, kWhite};
    constexpr double kTile = 0.6;
    const bool light = std::fmod(floor(point.x / kTile) + floor(point.z / kTile), 2) == 0;
    return {point, {0, 1, 0}, light ? kTileLight : kTileDark};
  }
  const bool skirting = point.y < -kHalf.y + 0.1;
  if (tx <= tz) {
    const double side = sign_of(d.x);
    return {point, {-side, 0, 0}, skirting ? kSkirting : side > 0 ? kRed : kGreen};
  }
  const double side = sign_of(d.z);
  return {point, {0, 0, -side}, skirting ? kSkirting : side > 0 ? kCream : kOchre};
}

/// Irradiance of second and later bounces. Flux Φ falls once on walls of mean albedo ρ and area A; what they
/// send back fills the room evenly with E = Φ ρ / (A (1 − ρ)).
Color bounced_irradiance() {
  const double side_x = 4 * kHalf.y * kHalf.z, side_y = 4 * kHalf.x * kHalf.z, side_z = 4 * kHalf.x * kHalf.y;
  const double area = 2 * (side_x + side_y + side_z);
  const Color floor = mix(kTileLight, kTileDark, 0.5);
  const Color rho =
      (1 / area) * (side_x * (kRed + kGreen) + side_y * (kWhite + floor) + side_z * (kCream + kOchre));
  const Color flux = kPi * (kPanel.area() * kPanelRadiance + kWindow.area() * kWindowMean);
  const auto even = [&](double phi, double r) { return phi * r / (area * (1 - r)); };
  return {even(flux.r, rho.r), even(flux.g, rho.g), even(flux.b, rho.b)};
}

Color look(const Vec3d& d, const Color& bounced) {
  const Surface surface = surface_along(d);
  double x = 0, y = 0;
  if (surface.normal.y < 0 && hit(kPanel, d, x, y) && abs(x) < 1 && abs(y) < 1) return kPanelRadiance;
  const bool in_window = surface.normal.z < 0 && hit(kWindow, d, x, y) && abs(x) < 1 && abs(y) < 1;
  if (in_window && !window_wood(x, y)) return window_sky(y);
  const Color albedo = in_window ? kWhite : surface.albedo;
  const Color light = irradiance_from(kPanel, surface.point, surface.normal) * kPanelRadiance +
                      irradiance_from(kWindow, surface.point, surface.normal) * kWindowMean + bounced;
  return (1 / kPi) * (albedo * light);
}

}  // namespace

Radiance make_room(const SynthOptions& options) {
  const double scale = scale_option(options, "room");
  return [scale, bounced = bounced_irradiance()](const Vec3d& d) {
    return to_radiance(scale * look(d, bounced));
  };
}

}  // namespace welkin::synth
