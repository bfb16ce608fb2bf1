#include "welkin/map_file/panorama.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "welkin/base/number_text.h"
#include "welkin/map_file/map_file_job.h"
#include "welkin/math/rotation.h"
#include "welkin/sphere/registry.h"

namespace welkin::map_file {
namespace {

using sphere::AnyParameterization;

constexpr double kDegrees = 180 / kPi;

std::string size_text(int width, int height) {
  return std::to_string(width) + "×" + std::to_string(height);
}

/// A window's edges, degrees, as `latlong` has them.
struct Window {
  double left = -180, right = 180, top = 90, bottom = -90;
};

std::string text_of(const Window& w) {
  std::string text = "latlong";
  const Window full;
  const auto add = [&](const char* name, double value, double plain) {
    if (value != plain) text += std::string(",") + name + "=" + number_text(value);
  };
  add("left", w.left, full.left);
  add("right", w.right, full.right);
  add("top", w.top, full.top);
  add("bottom", w.bottom, full.bottom);
  return text;
}

constexpr int kLargest = 1 << 29;  ///< of a declared number of texels

/// What isn't said filled in: twice as wide as high, and all of it.
io::Panorama complete(const io::Panorama& said) {
  io::Panorama p = said;
  if (p.full_width == 0 && p.full_height <= kLargest / 2) p.full_width = 2 * p.full_height;
  if (p.full_height == 0) p.full_height = p.full_width / 2;
  if (p.crop_width == 0 && p.crop_left >= 0) p.crop_width = p.full_width - p.crop_left;
  if (p.crop_height == 0 && p.crop_top >= 0) p.crop_height = p.full_height - p.crop_top;
  return p;
}

bool is_sound(const io::Panorama& p) {
  const auto within = [](int value, int least, int most) { return value >= least && value <= most; };
  return within(p.full_width, 1, kLargest) && within(p.full_height, 1, kLargest) &&
         within(p.crop_left, 0, p.full_width - 1) && within(p.crop_width, 1, p.full_width) &&
         within(p.crop_top, 0, p.full_height - 1) && within(p.crop_height, 1, p.full_height - p.crop_top);
}

/// Whether a picture can have that aspect: within one texel, or a hundredth.
bool has_aspect(ChartSize picture, double aspect) {
  const double wide = aspect * picture.height, high = picture.width / aspect;
  return std::fabs(wide - picture.width) <= std::max(1.0, 0.01 * wide) ||
         std::fabs(high - picture.height) < 1;
}

std::string refuse(const std::string& cause, std::vector<std::string>& warnings) {
  warnings.push_back("its metadata declare " + cause);
  return "";
}

/// Rows count from the pole, columns from −180°.
std::string equirectangular(const io::Panorama& said, ChartSize picture, std::vector<std::string>& warnings) {
  const std::string size = size_text(picture.width, picture.height);
  if (said.full_width == 0 && said.full_height == 0) {
    if (said.crop_width != 0 || said.crop_height != 0) {
      warnings.push_back(
          "its metadata declare a part of a panorama, but not the size of the whole: read as all of it");
    } else if (!has_aspect(picture, 2)) {
      warnings.push_back("its metadata declare a whole panorama: " + size +
                         " is read as such, its texels not square");
    }
    return "latlong";
  }
  const io::Panorama p = complete(said);
  const std::string part = size_text(p.crop_width, p.crop_height) + " texels at " +
                           std::to_string(p.crop_left) + ", " + std::to_string(p.crop_top) +
                           " of a panorama of " + size_text(p.full_width, p.full_height);
  if (!is_sound(p)) {
    warnings.push_back("its metadata declare " + part + ", which cannot be: read as all of it");
    return "latlong";
  }
  // Whole numbers divided once: to the last digit.
  const auto azimuth = [&](std::int64_t column) {
    return static_cast<double>(360 * column - std::int64_t{180} * p.full_width) / p.full_width;
  };
  const auto elevation = [&](std::int64_t row) {
    return static_cast<double>(std::int64_t{90} * p.full_height - 180 * row) / p.full_height;
  };
  const Window window{azimuth(p.crop_left), azimuth(std::int64_t{p.crop_left} + p.crop_width),
                      elevation(p.crop_top), elevation(std::int64_t{p.crop_top} + p.crop_height)};
  constexpr double kLeast = 0.1;  // that `latlong` takes
  if (window.right - window.left < kLeast || window.top - window.bottom < kLeast)
    return refuse(part + ", less than 0.1° of it: not read as such", warnings);
  if (!has_aspect(picture, (window.right - window.left) / (window.top - window.bottom))) {
    warnings.push_back("its metadata declare " + part + ": " + size +
                       " is read as that, its texels not square");
  }
  return text_of(window);
}

/// Rows count from the horizon, in units of the cylinder's radius times 2π / full_width.
std::string cylindrical(const io::Panorama& said, std::vector<std::string>& warnings) {
  io::Panorama p = said;
  if (p.crop_width == 0) p.crop_width = p.full_width;
  const bool said_enough =
      p.full_width > 0 && p.full_width <= kLargest && p.crop_height > 0 && p.crop_height <= kLargest;
  if (!said_enough)
    return refuse("a cylindrical panorama, but not its size: name the parameterization", warnings);
  if (p.crop_width != p.full_width || std::abs(2LL * p.crop_top + p.crop_height) > 1) {
    return refuse(
        "a part of a cylindrical panorama that isn't all around it and as high above the horizon as "
        "below: not read as such",
        warnings);
  }
  const double fov = 2 * kDegrees * std::atan(kPi * p.crop_height / p.full_width);
  if (fov < 1 || fov > 179) return refuse("a cylindrical panorama of " + number_text(fov) + "°", warnings);
  return "cylinder,fov=" + number_text(fov);
}

}  // namespace

std::string shape_of(const io::Panorama& panorama, ChartSize picture, std::vector<std::string>& warnings) {
  std::string projection = panorama.projection;
  for (char& c : projection) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
  if (projection == "equirectangular" || (projection.empty() && panorama.full_width > 0))
    return equirectangular(panorama, picture, warnings);
  if (projection == "cylindrical") return cylindrical(panorama, warnings);
  if (!projection.empty())
    warnings.push_back("its metadata declare the projection '" + panorama.projection +
                       "', which is unknown: name the parameterization");
  return "";
}

void tell_unused_panorama(ChartSize picture, MapFileInfo& info) {
  if (!info.image.panorama || !info.shape || info.reason == kByPanorama) return;
  std::vector<std::string> unused;
  const std::string text = shape_of(*info.image.panorama, picture, unused);
  if (text.empty()) return;
  const auto declared = AnyParameterization::make(text);
  const auto& p = info.shape->parameterization;
  bool same = p.charts() == 1;
  for (const double u : {0.25, 0.75}) {
    for (const double v : {0.25, 0.75})
      same = same && length(p.to_sphere(0, u, v) - declared.to_sphere(0, u, v)) < 1e-4;
  }
  if (same) return;
  info.image.warnings.push_back("its metadata declare " + text + ": not used, since " + p.spec() + " is " +
                                info.reason);
}

// The pose turns the picture's frame, right-handed about +Z (roll: what is to the right, −X, goes down),
// about +X (pitch: the centre, +Z, goes up, against the right-handed sense) and about +Y (heading: the centre
// goes right, toward −X, against it too).
std::optional<Matrix3> orientation_of(const io::Panorama& p) {
  if (!std::isfinite(p.heading) || !std::isfinite(p.pitch) || !std::isfinite(p.roll)) return std::nullopt;
  if (p.heading == 0 && p.pitch == 0 && p.roll == 0) return std::nullopt;
  return transpose(rotation_from_yaw_pitch_roll(-p.heading, -p.pitch, p.roll));
}

std::string pose_text(const io::Panorama& p) {
  return "pose of heading " + number_text(p.heading) + "°, pitch " + number_text(p.pitch) + "°, roll " +
         number_text(p.roll) + "°";
}

namespace {

Vec3d turned_right(const Vec3d& d, double degrees) {
  return rotation_from_yaw_pitch_roll(-degrees, 0, 0) * d;
}

/// The edges, where rows and columns are at even steps of elevation and azimuth.
std::optional<Window> window_of(const AnyParameterization& p) {
  if (p.charts() != 1 || !p.full_charts()) return std::nullopt;
  const auto at = [&](double u, double v) { return p.to_sphere(0, u, v); };
  const auto azimuth = [](const Vec3d& d) { return std::atan2(-d.x, d.z) * kDegrees; };
  const auto elevation = [](const Vec3d& d) { return std::asin(clamp(d.y, -1.0, 1.0)) * kDegrees; };
  // An eighth of a window is less than half a turn and passes no pole.
  const Vec3d middle = at(0.5, 0.5);
  const double centre = azimuth(middle), width = 8 * azimuth(turned_right(at(0.625, 0.5), -centre));
  const double height = 8 * (elevation(middle) - elevation(at(0.5, 0.625)));
  const Window w{centre - 0.5 * width, centre + 0.5 * width, elevation(middle) + 0.5 * height,
                 elevation(middle) - 0.5 * height};
  constexpr double kTolerance = 1e-9;
  if (!(width > 0 && width < 360 + kTolerance && w.top < 90 + kTolerance && w.bottom > -90 - kTolerance))
    return std::nullopt;
  for (const double u : {0.1, 0.3, 0.8}) {
    for (const double v : {0.1, 0.4, 0.9}) {
      const double up = (w.top - v * height) / kDegrees;
      const Vec3d expected = turned_right({0, std::sin(up), std::cos(up)}, w.left + u * width);
      if (length(at(u, v) - expected) > kTolerance) return std::nullopt;
    }
  }
  return w;
}

/// The whole number that a number is, nearly.
std::optional<int> whole(double number) {
  const double rounded = std::round(number);
  if (std::fabs(number - rounded) > 1e-3 || std::fabs(rounded) > (1 << 30)) return std::nullopt;
  return static_cast<int>(rounded);
}

/// 0 where rounding leaves next to nothing of it.
double clean(double degrees) {
  return std::fabs(degrees) < 1e-9 ? 0 : degrees;
}

/// Sets the pose: of the picture's frame in the world.
void set_pose(io::Panorama& panorama, const Matrix3& pose) {
  const auto& m = pose.rows;
  panorama.pitch = clean(std::asin(clamp(m[1][2], -1.0, 1.0)) * kDegrees);
  const bool upright = std::hypot(m[0][2], m[2][2]) > 1e-9;
  panorama.roll = upright ? clean(std::atan2(m[1][0], m[1][1]) * kDegrees) : 0;
  const double heading = upright ? std::atan2(-m[0][2], m[2][2]) : std::atan2(m[2][0], m[0][0]);
  panorama.heading = clean(heading * kDegrees);
  if (panorama.heading < 0) panorama.heading += 360;
}

}  // namespace

std::optional<io::Panorama> panorama_of(const MapFrame& frame) {
  if (determinant(frame.orientation) < 0) return std::nullopt;
  const std::optional<Window> window = window_of(frame.parameterization);
  if (!window) return std::nullopt;
  const double across = frame.size.width / (window->right - window->left);
  const double down = frame.size.height / (window->top - window->bottom);
  const std::optional<int> full_width = whole(360 * across), full_height = whole(180 * down);
  const std::optional<int> top = whole((90 - window->top) * down);
  if (!full_width || !full_height || !top) return std::nullopt;
  io::Panorama panorama{"equirectangular", *full_width, *full_height, frame.size.width, frame.size.height};
  panorama.crop_top = *top;
  // A window across the seam is one of a panorama that is turned.
  const bool inside = window->left > -180 - 1e-9 && window->right < 180 + 1e-9;
  double turn = 0;
  if (inside) {
    const std::optional<int> left = whole((window->left + 180) * across);
    if (!left) return std::nullopt;
    panorama.crop_left = *left;
  } else {
    panorama.crop_left = (*full_width - frame.size.width) / 2;
    turn = window->left + 180 - panorama.crop_left / across;
  }
  set_pose(panorama, transpose(frame.orientation) * rotation_from_yaw_pitch_roll(-turn, 0, 0));
  return panorama;
}

}  // namespace welkin::map_file
