#pragma once

#include <concepts>
#include <string>

#include "welkin/sphere/lens.h"
#include "welkin/sphere/parameterization.h"

namespace welkin::sphere {

/// What a camera with a lens sees: a rectangle of its image plane. Centre +Z, right −X, up +Y, seen from
/// inside, as fish-eyes have it (fisheye_lens.h), whose disc is a part of such a rectangle. Past its edges
/// the image plane goes on.
///
/// The field of view is the angle between two opposite edges, through the axis, or between corners, before
/// the frame is shifted. `aspect` 0 stands for that of the picture: at_size sets it. Call update() after
/// changing a parameter. All lenses share this struct and its kernels.
class Frame {
 public:
  static constexpr int kCharts = 1;
  static constexpr Traits kTraits{.projection = Projection::disc, .follows_aspect = true};
  static constexpr double kLeast = 0.1;    ///< field of view, degrees: directions are floats
  static constexpr double kLargest = 300;  ///< |x| and |y| at an edge
  using KernelStruct = Frame;

  double fov;                ///< horizontal, degrees
  double vfov = 0;           ///< vertical, degrees, in place of fov; 0: not given
  double dfov = 0;           ///< diagonal, the same
  double ratio = 0;          ///< width over height
  double right = 0, up = 0;  ///< shift of the frame, in its widths and heights
  double rim;                ///< of radial lenses: what is seen, edge to edge, degrees
  PanniniShape shape;

  double aspect() const { return ratio > 0 ? ratio : 1; }

  void update();
  /// What makes it no frame; empty when it is one.
  std::string fault() const;

  template <class Visitor>
  void visit_parameters(Visitor&& visit) {
    visit_all(*this, visit);
    update();
  }
  template <class Visitor>
  void visit_parameters(Visitor&& visit) const {
    visit_all(*this, visit);
  }

  template <class T>
  Vec3<T> to_sphere(int, T u, T v) const {
    return direction_at(lens_, shape, plane_point(u, v));
  }

  template <class T>
  ChartPoint<T> from_sphere(const Vec3<T>& d) const {
    const PlanePoint<T> at = point_of(lens_, shape, d);
    return {constant<T>(0), constant<T>(0.5 / half_width_) * at.x + constant<T>(0.5 - right),
            constant<T>(0.5 + up) - constant<T>(0.5 / half_height_) * at.y};
  }

  template <class T>
  T solid_angle_density(int, T u, T v) const {
    return constant<T>(4 * half_width_ * half_height_) * density_at(lens_, shape, plane_point(u, v));
  }

  template <class T>
  Mask<T> valid(int, T u, T v) const {
    const PlanePoint<T> at = plane_point(u, v);
    if (is_radial(lens_))
      return at.x * at.x + at.y * at.y <= constant<T>(rim_distance_ * rim_distance_ * (1 + 1e-9));
    if (lens_ == Lens::cylindrical) return abs(at.x) <= constant<T>(kPi * (1 + 1e-9));
    return u == u;
  }

  /// Edges count as covered, with what rounding adds.
  template <class T>
  Mask<T> covers(const Vec3<T>& d) const {
    const ChartPoint<T> at = from_sphere(d);
    const T half = constant<T>(0.5), most = constant<T>(std::same_as<T, double> ? 0.5 + 1e-12 : 0.5 + 1e-6);
    const Mask<T> across = abs(at.u - half) <= most, down = abs(at.v - half) <= most;
    const Mask<T> inside = across & down;
    if (lens_ == Lens::cylindrical) return inside;
    if (is_radial(lens_)) {
      const Mask<T> before_rim = d.z >= constant<T>(rim_cosine_) * length(d);
      return inside & before_rim;
    }
    // Past the last column of the plane S is no longer S.
    const T level = sqrt(d.x * d.x + d.z * d.z);
    const Mask<T> before_last = constant<T>(shape.distance) * level + d.z >= constant<T>(1e-4) * level;
    return inside & before_last;
  }
  double coverage() const { return coverage_; }

 protected:
  /// `widest`: the largest field of view; and of radial lenses, what they see at most.
  Frame(Lens lens, double fov_degrees, double widest, double sees);

 private:
  template <class Self, class Visitor>
  static void visit_all(Self& self, Visitor& visit) {
    const bool radial = is_radial(self.lens_);
    const double high = radial ? self.widest_ : 179;
    visit("fov", self.fov, kLeast, self.widest_, "horizontal field of view, degrees");
    visit("vfov", self.vfov, 0.0, high, "vertical field of view in place of fov, degrees; 0: fov says it");
    visit("dfov", self.dfov, 0.0, high, "diagonal field of view in place of fov, degrees; 0: fov says it");
    visit("aspect", self.ratio, 0.0, 1000.0, "width over height; 0: the picture's");
    visit("right", self.right, -1.0, 1.0, "shift of the frame to the right, in widths");
    visit("up", self.up, -1.0, 1.0, "shift of the frame upwards, in heights");
    if (radial && self.lens_ != Lens::perspective)
      visit("rim", self.rim, kLeast, self.sees_, "angle that the lens sees, rim to rim, degrees");
    if (self.lens_ != Lens::pannini) return;
    visit("d", self.shape.distance, 0.0, 1.0, "distance of the second centre, in radii; 0 is perspective");
    visit("vertical", self.shape.vertical, 0.0, 1.0, "vertical compression; 1 keeps horizontals straight");
  }

  template <class T>
  PlanePoint<T> plane_point(T u, T v) const {
    return {constant<T>(2 * half_width_) * (u + constant<T>(right - 0.5)),
            constant<T>(2 * half_height_) * (constant<T>(0.5 + up) - v)};
  }

  double distance_at(double degrees) const;
  double angle_across() const;
  void find_size();
  double height_of_diagonal(double angle) const;
  double find_coverage() const;
  double edge(double x0, double y0, double x1, double y1) const;

  Lens lens_;
  // Only visitors read these.
  [[maybe_unused]] double widest_, sees_;
  double half_width_ = 1, half_height_ = 1;    // of the plane
  double rim_cosine_ = -2, rim_distance_ = 0;  // of radial lenses
  double coverage_ = 0;
};

/// r = tan θ.
struct Perspective : Frame {
  static constexpr const char* kName = "perspective";
  explicit Perspective(double fov_degrees = 90) : Frame(Lens::perspective, fov_degrees, 179, 180) {}
};
/// x = S sin φ, y = S tan β.
struct Pannini : Frame {
  static constexpr const char* kName = "pannini";
  explicit Pannini(double fov_degrees = 150) : Frame(Lens::pannini, fov_degrees, 350, 360) {}
};
/// x = φ, y = tan β.
struct Cylindrical : Frame {
  static constexpr const char* kName = "cylindrical";
  static constexpr Traits kTraits{
      .projection = Projection::panorama, .density_by_row = true, .follows_aspect = true};
  explicit Cylindrical(double fov_degrees = 180) : Frame(Lens::cylindrical, fov_degrees, 360, 360) {}
};
/// r = 2 tan(θ/2).
struct Stereographic : Frame {
  static constexpr const char* kName = "stereographic";
  explicit Stereographic(double fov_degrees = 180) : Frame(Lens::stereographic, fov_degrees, 359, 359) {}
};
/// r = θ.
struct Equidistant : Frame {
  static constexpr const char* kName = "equidistant";
  explicit Equidistant(double fov_degrees = 180) : Frame(Lens::equidistant, fov_degrees, 360, 360) {}
};
/// r = 2 sin(θ/2). The corners of a square of 180° would meet in −Z, so the default is less.
struct Equisolid : Frame {
  static constexpr const char* kName = "equisolid";
  explicit Equisolid(double fov_degrees = 150) : Frame(Lens::equisolid, fov_degrees, 360, 360) {}
};
/// r = sin θ. At 180° the rim is singular, as that of FisheyeOrthographic.
struct Orthographic : Frame {
  static constexpr const char* kName = "orthographic";
  explicit Orthographic(double fov_degrees = 80) : Frame(Lens::orthographic, fov_degrees, 180, 180) {}
};

}  // namespace welkin::sphere
