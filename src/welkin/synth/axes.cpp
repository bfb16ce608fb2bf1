#include <string>

#include "welkin/image/font.h"
#include "welkin/math/angles.h"
#include "welkin/sphere/cube.h"
#include "welkin/synth/color.h"
#include "welkin/synth/maps.h"

/// The labelled test card. Everything is painted in layers, later over earlier, each a test of distance.
///
/// A side of the cube is drawn in its plane, x right and y down as seen from the centre of the world. The u
/// of a native face runs the other way (the look-up rule of docs/conventions.md mirrors faces), and its v
/// runs down alike, so x = −u, y = v; a native face shows this card mirrored, as it must, and every picture
/// from inside shows it readable.
namespace welkin::synth {
namespace {

constexpr Color kCream{0.9216, 0.8714, 0.7605}, kInk{0.0130, 0.0103, 0.0116};

/// One side of the cube: a hue for each axis, light with dark ink for +, dark with cream ink for −.
struct Side {
  const char* name;
  Color ground, ink;
};
constexpr Side kSides[6] = {{"+X", {0.8070, 0.1912, 0.1470}, kInk}, {"-X", {0.2542, 0.0284, 0.0284}, kCream},
                            {"+Y", {0.3325, 0.5520, 0.1441}, kInk}, {"-Y", {0.0497, 0.1329, 0.0319}, kCream},
                            {"+Z", {0.2122, 0.4233, 0.7231}, kInk}, {"-Z", {0.0252, 0.0723, 0.2232}, kCream}};

/// Name of the axis along a unit vector that has one component.
const char* axis_name(const Vec3d& a) {
  const auto face = static_cast<int>(sphere::cube_face_of(a).chart);
  return kSides[face].name;
}

/// Cells of 15° of longitude and latitude, every other one a little darker.
double cell_shade(double azimuth, double elevation) {
  return std::fmod(floor(azimuth / 15) + floor(elevation / 15), 2) == 0 ? 1.0 : 0.88;
}

/// Meridians and parallels every 15°, fewer meridians toward the poles; the three great circles of the axes
/// are thicker.
/// Returns 0: no line, 1: thin, 2: thick.
int grid_line(const Vec3d& d, double azimuth, double elevation) {
  constexpr double kThin = 0.14, kThick = 0.4;  // half widths, degrees
  const double thick = sin(kThick * kDegree);
  if (abs(d.x) < thick || abs(d.y) < thick || abs(d.z) < thick) return 2;
  const double parallel = std::remainder(elevation, 15);
  const double step = abs(elevation) < 60 ? 15 : abs(elevation) < 75 ? 30 : 90;
  const double meridian = cos(elevation * kDegree) * abs(sin(std::remainder(azimuth, step) * kDegree));
  return abs(parallel) < kThin || meridian < sin(kThin * kDegree) ? 1 : 0;
}

/// The target around each corner of the cube: black and white rings, each 0.8 times as wide as the one
/// outside it, so that the radius where they merge shows the resolution. False outside; `white` says which.
bool corner_target(const Vec3d& d, bool& white) {
  constexpr double kRadius = 7;
  const double cosine = (abs(d.x) + abs(d.y) + abs(d.z)) / std::sqrt(3.0);
  if (cosine < cos(kRadius * kDegree)) return false;
  const Vec3d corner{copysign(1.0, d.x), copysign(1.0, d.y), copysign(1.0, d.z)};
  double edge = kRadius;
  const double angle = angle_between(d, corner) / kDegree;
  for (white = true; angle < edge * 0.8 && edge > 0.1; edge *= 0.8) white = !white;
  return true;
}

/// What covers a rectangle with round ends around a text: 0 outside, 1 plate, 2 ink. `height` of capitals is
/// in the units of (x, y).
int plate(const std::string& text, double height, double x, double y) {
  constexpr double kMargin = 0.55, kHalfWeight = 0.085;
  const double h = 0.5 + kMargin, w = text_width(text) / 2 + kMargin;
  x /= height, y /= height;
  if (abs(y) > h || abs(x) > w + h / 2) return 0;
  const double beyond = max(abs(x) - (w - h / 2), 0.0);
  if (std::hypot(beyond, y) > h) return 0;
  return text_distance(text, x, y) < kHalfWeight ? 2 : 1;
}

/// The middle of a side: a disc with the side's name, in a bezel of 72 black and white teeth, 5° each.
/// Returns false outside.
bool centre(const Side& side, double x, double y, Color& color) {
  const double radius = std::hypot(x, y);
  const double angle = std::atan(radius) / kDegree;
  if (angle > 29) return false;
  if (angle > 28.4) {
    color = side.ink;
  } else if (angle > 26) {
    const double turn = atan2(x, -y) / kDegree;
    color = std::fmod(floor(turn / 5), 2) == 0 ? kCream : kInk;
  } else if (angle > 25.4) {
    color = side.ink;
  } else {
    constexpr double kHeight = 0.40, kHalfWeight = 0.095;
    color = text_distance(side.name, x / kHeight, y / kHeight) < kHalfWeight ? side.ink : side.ground;
  }
  return true;
}

/// Toward each edge of a side: the name of the axis that lies beyond it, and an arrowhead. Returns false
/// elsewhere.
bool signpost(int face, const Color& ground, double x, double y, Color& color) {
  const Side& side = kSides[face];
  const sphere::CubeFace& frame = sphere::kCubeFaces[face];
  const bool sideways = abs(x) > abs(y);
  const double outward = sideways ? abs(x) : abs(y), across = sideways ? abs(y) : abs(x);
  // Arrowhead from its base at 0.85 to its tip at 0.95 of the plane.
  constexpr double kBase = 0.85, kTip = 0.95;
  if (outward > kBase && across < 0.75 * (kTip - outward)) {
    color = side.ink;
    return true;
  }
  const double sign = (sideways ? x : y) < 0 ? -1 : 1;
  const Vec3d beyond = sideways ? -sign * frame.right : sign * frame.down;
  constexpr double kMiddle = 0.71, kHeight = 0.095;
  const double middle = sign * kMiddle;
  const int cover =
      plate(axis_name(beyond), kHeight, x - (sideways ? middle : 0), y - (sideways ? 0 : middle));
  if (cover > 0) color = cover == 2 ? side.ink : ground;
  return cover > 0;
}

/// The azimuth in degrees, at 30° and 60° of each quarter, above and below the horizon. Returns false
/// elsewhere.
bool azimuth_label(const Color& ground, const Color& ink, const Vec3d& d, Color& color) {
  constexpr double kElevation = 22.5, kHeight = 0.042;
  const double nearest = 30 * std::round(atan2(d.x, d.z) / kDegree / 30);
  if (std::remainder(nearest, 90) == 0) return false;
  const Vec3d at = direction_at(nearest, d.y < 0 ? -kElevation : kElevation);
  const double forward = dot(d, at);
  if (forward < 0.98) return false;
  const Vec3d right = direction_at(nearest - 90, 0), down = cross(at, right);
  const int degrees = (static_cast<int>(nearest) + 360) % 360;
  const int cover =
      plate(std::to_string(degrees) + 'o', kHeight, dot(d, right) / forward, dot(d, down) / forward);
  if (cover > 0) color = cover == 2 ? ink : ground;
  return cover > 0;
}

Color paint(const Vec3d& d) {
  const sphere::ChartPoint<double> position = sphere::cube_face_of(d);
  const auto face = static_cast<int>(position.chart);
  const Side& side = kSides[face];
  const double x = -position.u, y = position.v;
  const double azimuth = atan2(d.x, d.z) / kDegree;
  const double elevation = atan2(d.y, sqrt(d.x * d.x + d.z * d.z)) / kDegree;

  const Color ground = cell_shade(azimuth, elevation) * side.ground;
  Color color{};
  if (centre(side, x, y, color) || signpost(face, ground, x, y, color)) return color;
  if (azimuth_label(ground, side.ink, d, color)) return color;
  if (bool white = false; corner_target(d, white)) return white ? kCream : kInk;
  const int line = grid_line(d, azimuth, elevation);
  return line == 2 ? side.ink : line == 1 ? mix(ground, side.ink, 0.75) : ground;
}

}  // namespace

Radiance make_axes(const SynthOptions& options) {
  const double scale = scale_option(options, "axes");
  return [scale](const Vec3d& d) { return to_radiance(scale * paint(d)); };
}

}  // namespace welkin::synth
