#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "welkin/sphere/parameterization.h"
#include "welkin/sphere/polar.h"

namespace welkin::sphere {

/// The part of LatLong between two azimuths and two elevations. Its formulas turn about +Y, so that the part
/// is centred on +Z: its seam is as far from it as can be, and small angles are precise. Past its edges
/// LatLong continues, past a pole down the opposite meridian.
class LatLongPart {
 public:
  static constexpr int kCharts = 1;
  static constexpr Traits kTraits{.projection = Projection::panorama, .density_by_row = true};

  double aspect() const { return width_ / height_; }

  template <class T>
  Vec3<T> to_sphere(int, T u, T v) const {
    const T half = constant<T>(0.5);
    const T longitude = constant<T>(width_) * (half - u);
    const T elevation = constant<T>(middle_) + constant<T>(height_) * (half - v);
    const T across = cos(elevation), x = across * sin(longitude), z = across * cos(longitude);
    return {x * constant<T>(turn_.cosine) - z * constant<T>(turn_.sine), sin(elevation),
            z * constant<T>(turn_.cosine) + x * constant<T>(turn_.sine)};
  }

  template <class T>
  ChartPoint<T> from_sphere(const Vec3<T>& d) const {
    const T x = left_of(d), z = front_of(d), half = constant<T>(0.5);
    const T longitude = polar_angle(x, z), elevation = polar_angle(d.y, sqrt(x * x + z * z));
    return {constant<T>(0), half - constant<T>(1 / width_) * longitude,
            half - constant<T>(1 / height_) * (elevation - constant<T>(middle_))};
  }

  template <class T>
  T solid_angle_density(int, T, T v) const {
    return constant<T>(width_ * height_) *
           cos(constant<T>(middle_) + constant<T>(height_) * (constant<T>(0.5) - v));
  }

  template <class T>
  Mask<T> valid(int, T u, T) const {
    return u == u;
  }
  /// By the sines of the angles past the edges.
  template <class T>
  Mask<T> covers(const Vec3<T>& d) const {
    const T x = left_of(d), z = front_of(d), across = sqrt(x * x + z * z);
    const auto beside = abs(x) * constant<T>(side_.cosine) <= z * constant<T>(side_.sine);
    const auto below_top = d.y * constant<T>(top_.cosine) <= across * constant<T>(top_.sine);
    const auto above_bottom = d.y * constant<T>(bottom_.cosine) >= across * constant<T>(bottom_.sine);
    return beside & below_top & above_bottom;
  }
  double coverage() const {
    return width_ * 2 * std::cos(middle_) * std::sin(0.5 * height_);  // width · (sin top − sin bottom)
  }

 protected:
  /// Degrees, as LatLongWindow has them.
  void set_window(double left, double right, double top, double bottom) {
    constexpr double kRadians = kPi / 180;
    width_ = (right - left) * kRadians;
    height_ = (top - bottom) * kRadians;
    middle_ = 0.5 * (top + bottom) * kRadians;
    turn_ = angle_of(0.5 * (left + right));
    side_ = angle_of(0.5 * (right - left));
    top_ = angle_of(top);
    bottom_ = angle_of(bottom);
  }

 private:
  struct Angle {
    double cosine = 1, sine = 0;
  };
  /// Exact for quarter turns: all the way round, and up to a pole, nothing lies outside.
  static Angle angle_of(double degrees) {
    const double quarters = std::round(degrees / 90), rest = (degrees - 90 * quarters) * (kPi / 180);
    const double c = std::cos(rest), s = std::sin(rest);
    switch (static_cast<int>(quarters) & 3) {
      case 0:
        return {c, s};
      case 1:
        return {-s, c};
      case 2:
        return {-c, -s};
      default:
        return {s, -c};
    }
  }
  template <class T>
  T left_of(const Vec3<T>& d) const {
    return d.x * constant<T>(turn_.cosine) + d.z * constant<T>(turn_.sine);
  }
  template <class T>
  T front_of(const Vec3<T>& d) const {
    // 0 at a pole, not −0, which is behind.
    return d.z * constant<T>(turn_.cosine) - d.x * constant<T>(turn_.sine) + constant<T>(0);
  }

  double width_ = 2 * kPi, height_ = kPi, middle_ = 0;  // radians; the elevation of the middle
  Angle turn_;                                          // from +Z to the middle, to the right
  Angle side_{-1, 0}, top_{0, 1}, bottom_{0, -1};       // from the middle to the sides; the elevations
};

/// LatLong with parameters: the window from azimuth `left` to `right` and from elevation `top` down to
/// `bottom`, degrees. Azimuths grow to the right in the picture, 0 at LatLong's centre; a window may cross
/// ±180 and is up to 360 wide. Call update() after changing them.
struct LatLongWindow : LatLongPart {
  static constexpr const char* kName = "latlong";
  static constexpr double kLeast = 0.1;  ///< width and height, degrees: directions are floats
  double left = -180, right = 180, top = 90, bottom = -90;

  void update() { set_window(left, right, top, bottom); }

  /// What makes it no window; empty when it is one.
  std::string fault() const {
    if (!(right - left >= kLeast && right - left <= 360))
      return "right must be 0.1° to 360° beyond left, growing to the right in the picture";
    if (!(top - bottom >= kLeast)) return "top must be at least 0.1° above bottom";
    return "";
  }

  template <class Visitor>
  void visit_parameters(Visitor&& visit) {
    visit_all(*this, visit);
    update();
  }
  template <class Visitor>
  void visit_parameters(Visitor&& visit) const {
    visit_all(*this, visit);
  }

 private:
  template <class Self, class Visitor>
  static void visit_all(Self& self, Visitor& visit) {
    visit("left", self.left, -360.0, 360.0, "azimuth of the left edge, degrees to the right of the centre");
    visit("right", self.right, -360.0, 720.0,
          "azimuth of the right edge, degrees to the right of the centre");
    visit("top", self.top, -90.0, 90.0, "elevation of the top edge, degrees");
    visit("bottom", self.bottom, -90.0, 90.0, "elevation of the bottom edge, degrees");
  }
};

/// VR180: the half of LatLong in front, from pole to pole. With `fov` (degrees) other than 180 it is that
/// wide, and as high up to 180. Call update() after changing it.
struct Vr180 : LatLongPart {
  static constexpr const char* kName = "vr180";
  double fov = 180;

  explicit Vr180(double fov_degrees = 180) : fov(fov_degrees) { update(); }

  void update() {
    const double high = std::min(fov, 180.0);
    set_window(-0.5 * fov, 0.5 * fov, 0.5 * high, -0.5 * high);
  }

  template <class Visitor>
  void visit_parameters(Visitor&& visit) {
    visit("fov", fov, 1.0, 360.0, "field of view, degrees; the height at most 180");
    update();
  }
  template <class Visitor>
  void visit_parameters(Visitor&& visit) const {
    visit("fov", fov, 1.0, 360.0, "field of view, degrees; the height at most 180");
  }
};

}  // namespace welkin::sphere
