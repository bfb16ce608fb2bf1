#pragma once

#include "welkin/sphere/disc.h"

namespace welkin::sphere {

/// A fish-eye picture: a disc inscribed in the square, radius r a function of the angle θ from the centre
/// alone, with θ = fov/2 at the rim. Centre +Z, right −X, up +Y, seen from inside. Past the rim the function
/// continues. `Lens` is the struct that inherits this and says how r and θ are related:
///
///     static double scale_of(double half_fov);            // the lens's one constant, from fov/2 in radians
///     template <class T> Ray<T> ray(T radius) const;      // θ of r
///     template <class T> T radius(const Polar<T>&) const; // r of θ, finite for every direction
///     template <class T> T density(T radius) const;       // 4 sin θ/r dθ/dr: dω = sin θ dθ dφ and r dr dφ =
///     4 du dv
///
/// Call update() after changing `fov` (degrees, rim to rim, at most Lens::kWidest).
template <class Lens>
struct Fisheye {
  static constexpr int kCharts = 1;
  static constexpr Traits kTraits{.projection = Projection::disc};
  double fov = 180;

  explicit Fisheye(double fov_degrees = 180) : fov(fov_degrees) { update(); }
  double aspect() const { return 1; }

  void update() {
    scale = Lens::scale_of(fov * (kPi / 360));
    // A sine, so that it is exactly 0 at 180°.
    rim_cosine = std::sin(kPi * (0.5 - fov / 360));
    covered_from = fov < 360 ? rim_cosine : -2;
  }

  template <class Visitor>
  void visit_parameters(Visitor&& visit) {
    visit("fov", fov, 1.0, Lens::kWidest, "full field of view, degrees");
    update();
  }
  template <class Visitor>
  void visit_parameters(Visitor&& visit) const {
    visit("fov", fov, 1.0, Lens::kWidest, "full field of view, degrees");
  }

  template <class T>
  Vec3<T> to_sphere(int, T u, T v) const {
    const DiscPoint<T> p = disc_point(u, v);
    const Ray<T> ray = static_cast<const Lens*>(this)->ray(p.radius);
    return {-p.right * ray.sine_over_radius, p.up * ray.sine_over_radius, ray.cosine};
  }

  template <class T>
  ChartPoint<T> from_sphere(const Vec3<T>& d) const {
    const Polar<T> polar = polar_of(d);
    return disc_chart_point(-polar.x, polar.y, static_cast<const Lens*>(this)->radius(polar));
  }

  template <class T>
  T solid_angle_density(int, T u, T v) const {
    return static_cast<const Lens*>(this)->density(disc_point(u, v).radius);
  }

  template <class T>
  Mask<T> valid(int, T u, T v) const {
    return disc_point(u, v).radius <= constant<T>(1);
  }

  template <class T>
  Mask<T> covers(const Vec3<T>& d) const {
    return d.z >= constant<T>(covered_from) * length(d);
  }
  double coverage() const { return 2 * kPi * (1 - rim_cosine); }

 protected:
  double scale = 0, rim_cosine = 0, covered_from = 0;  ///< derived from `fov` by update()
};

}  // namespace welkin::sphere
