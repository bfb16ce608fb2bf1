#include <algorithm>
#include <vector>

#include "welkin/math/angles.h"
#include "welkin/synth/area_light.h"
#include "welkin/synth/color.h"
#include "welkin/synth/maps.h"

/// A photographic studio in metres, the camera at the origin: a round cove of dark grey (a floor that curves
/// up into a wall) lit exactly by six boxes, without shadows or further bounces.
namespace welkin::synth {
namespace {

struct Box {
  AreaLight light;
  Color radiance;   // of the middle
  double hot_spot;  // how much less bright the corners are, 0…1
};

std::vector<Box> boxes() {
  const auto at = [](double azimuth, double elevation, double distance, double width, double height) {
    return light_facing_origin(direction_at(azimuth, elevation), distance, width, height);
  };
  return {
      {at(48, 32, 3.0, 1.5, 1.5), {130, 122, 110}, 0.45},    // key
      {at(-52, 14, 3.4, 2.0, 2.0), {10, 11, 12.5}, 0.35},    // fill
      {at(0, 66, 2.8, 1.9, 0.9), {32, 32, 32}, 0.40},        // overhead
      {at(-105, 8, 3.0, 0.32, 2.5), {60, 62, 66}, 0.20},     // strip
      {at(158, 16, 3.2, 0.28, 1.9), {200, 168, 120}, 0.20},  // warm rim
      {at(-155, 16, 3.2, 0.28, 1.9), {95, 130, 190}, 0.20},  // cool rim
  };
}

constexpr double kFloor = -1.4, kRadius = 5.0;  // the floor's height and the wall's distance
constexpr double kAlbedo = 0.045;

/// Radiance of the cove in a direction.
Color cove(const std::vector<Box>& all, const Vec3d& d) {
  // Profile length s: along the floor to the wall at kRadius, then up the wall; the normal turns gradually
  // from one to the other.
  const double level = max(sqrt(d.x * d.x + d.z * d.z), 1e-9);
  const Vec3d out{d.x / level, 0, d.z / level};
  const bool on_floor = d.y < 0 && level * kFloor / d.y < kRadius;
  const double distance = on_floor ? kFloor / d.y : kRadius / level;
  constexpr double kFarthest = 1e3;  // straight up, where the wall has no end
  const Vec3d point = min(distance, kFarthest) * d;
  const double s = on_floor ? level * distance : kRadius + point.y - kFloor;
  const double turn = kPi / 2 * smooth_step(kRadius - 1.6, kRadius + 1.6, s);
  const Vec3d normal = cos(turn) * Vec3d{0, 1, 0} - sin(turn) * out;

  Color sum{0, 0, 0};
  for (const Box& box : all) {
    const double mean = 1 - 0.5 * box.hot_spot;
    sum = sum + (mean * irradiance_from(box.light, point, normal)) * box.radiance;
  }
  // A grey paper of even albedo, and a little stray light.
  return (kAlbedo / kPi) * sum + Color{0.004, 0.004, 0.0045};
}

/// Radiance of the cloth at (x, y) ∈ [−1, 1]² of a box: brightest in the middle, falling off smoothly at the
/// edges.
Color cloth(const Box& box, double x, double y) {
  const double middle = 1 - box.hot_spot * min(0.5 * (x * x + y * y), 1.0);
  const double hem_x = 0.12 * min(box.light.half_height / box.light.half_width, 1.0) + 0.02;
  const double hem_y = 0.12 * min(box.light.half_width / box.light.half_height, 1.0) + 0.02;
  const double hem = smooth_step(0, hem_x, 1 - abs(x)) * smooth_step(0, hem_y, 1 - abs(y));
  return (middle * (0.08 + 0.92 * hem)) * box.radiance;
}

}  // namespace

Radiance make_studio(const SynthOptions& options) {
  const double scale = scale_option(options, "studio");
  return [scale, all = boxes()](const Vec3d& d) {
    constexpr double kFrame = 0.045;  // metres of black housing around the cloth
    for (const Box& box : all) {
      double x = 0, y = 0;
      if (!hit(box.light, d, x, y)) continue;
      if (abs(x) < 1 && abs(y) < 1) return to_radiance(scale * cloth(box, x, y));
      const double beyond =
          std::max((abs(x) - 1) * box.light.half_width, (abs(y) - 1) * box.light.half_height);
      if (beyond < kFrame) return to_radiance(scale * Color{0.003, 0.003, 0.003});
    }
    return to_radiance(scale * cove(all, d));
  };
}

}  // namespace welkin::synth
