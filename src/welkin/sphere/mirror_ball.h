#pragma once

#include <limits>

#include "welkin/sphere/disc.h"

namespace welkin::sphere {

/// The photograph of a mirror ball by a camera on +Z, `distance` ball radii from the ball's centre (> 1;
/// infinity gives SphereMap), cropped to the ball's outline: the radius in the picture is the tangent of the
/// angle ψ from the camera's axis over that of the outline, 1/√(distance² − 1). Centre +Z, right +X, up +Y,
/// mirrored as SphereMap. The ball hides a cone around −Z, of half angle blind_angle() = asin(1/distance): it
/// is not covered. Past the rim the mirror image of the far side of the ball continues, through the cone.
///
/// With i the angle between the ray and the ball's normal, and the triangle of camera, centre and the point
/// that the ray meets: sin i = distance · sin ψ, and the reflected ray makes θ = 2i − ψ with +Z. With q =
/// 1/distance, κ = 1/√(1 − q²), τ = q κ and r the radius in the picture, tan ψ = τ r, w = cos ψ = 1/√(1 + τ²
/// r²), sin i = κ r w, cos i = √(1 − r²) w. Call update() after changing `distance`.
struct MirrorBall {
  static constexpr const char* kName = "mirror-ball";
  static constexpr int kCharts = 1;
  double distance = std::numeric_limits<double>::infinity();

  explicit MirrorBall(double distance_in_radii = std::numeric_limits<double>::infinity())
      : distance(distance_in_radii) {
    update();
  }
  double aspect() const { return 1; }
  /// Half angle, radians, of the cone around −Z that the ball hides.
  double blind_angle() const { return std::asin(1 / distance); }

  void update() {
    nearness = 1 / distance;
    rim_cosine = std::sqrt((1 - nearness) * (1 + nearness));
    incidence = 1 / rim_cosine;
    tangent = nearness * incidence;
    covered_from = nearness > 0 ? -rim_cosine : -2;
  }

  template <class Visitor>
  void visit_parameters(Visitor&& visit) {
    visit("distance", distance, kNearest, std::numeric_limits<double>::infinity(), kDescription);
    update();
  }
  template <class Visitor>
  void visit_parameters(Visitor&& visit) const {
    visit("distance", distance, kNearest, std::numeric_limits<double>::infinity(), kDescription);
  }

  template <class T>
  Vec3<T> to_sphere(int, T u, T v) const {
    const DiscPoint<T> p = disc_point(u, v);
    const Arc<T> arc = arc_of_sine(p.radius);
    const T one = constant<T>(1), two = constant<T>(2), k = constant<T>(incidence), t = constant<T>(tangent);
    const T sine = k * arc.sine, tilt = t * arc.sine;
    const T w = one / sqrt(one + tilt * tilt), w3 = w * w * w;
    const T double_cosine = arc.cosine * arc.cosine - sine * sine;
    const T scale = arc.ratio * w3 * (two * k * arc.cosine - t * double_cosine);
    return {p.right * scale, p.up * scale, w3 * (double_cosine + two * sine * arc.cosine * tilt)};
  }

  /// Solves 2i − asin(q sin i) = θ for i by Newton's steps: the left side is convex and its slope at least 1.
  template <class T>
  ChartPoint<T> from_sphere(const Vec3<T>& d) const {
    const T one = constant<T>(1), two = constant<T>(2), half = constant<T>(0.5), q = constant<T>(nearness);
    const Polar<T> polar = polar_of(d);
    const T theta = polar.angle();
    T i = half * (theta + asin(q * polar.half_sine()));
    for (int step = 0; step < kNewtonSteps; ++step) {
      const T sine = q * sin(i);
      const T slope = two - q * cos(i) / sqrt((one - sine) * (one + sine));
      i = i - (two * i - asin(sine) - theta) / slope;
    }
    const T sine = sin(i), t = constant<T>(tangent), k = constant<T>(incidence);
    const T radius = sine / sqrt(k * k - t * t * sine * sine);
    const auto beyond = i > constant<T>(kPi / 2);
    return disc_chart_point(polar.x, polar.y, select(beyond, two - radius, radius));
  }

  /// 4 sin θ/r dθ/dr, with di/dr = κ w²/√(1 − r²) and dψ/dr = τ w². Infinite at the rim of a finite distance:
  /// there √(1 − r²) is taken as at least 10⁻⁴.
  template <class T>
  T solid_angle_density(int, T u, T v) const {
    const T one = constant<T>(1), two = constant<T>(2), k = constant<T>(incidence), t = constant<T>(tangent);
    const Arc<T> arc = arc_of_sine(disc_point(u, v).radius);
    const T sine = k * arc.sine, tilt = t * arc.sine;
    const T w2 = one / (one + tilt * tilt);
    const T bend = t * (arc.cosine * arc.cosine - sine * sine);
    const T cosine = max(arc.cosine, constant<T>(1e-4));
    return constant<T>(4) * w2 * w2 * sqrt(w2) * (two * k - bend / cosine) * (two * k - t * arc.cosine);
  }

  template <class T>
  Mask<T> valid(int, T u, T v) const {
    return disc_point(u, v).radius <= constant<T>(1);
  }
  template <class T>
  Mask<T> covers(const Vec3<T>& d) const {
    return d.z >= constant<T>(covered_from) * length(d);
  }
  double coverage() const { return 2 * kPi * (1 + rim_cosine); }

 private:
  static constexpr double kNearest = 1.01;
  static constexpr const char* kDescription = "from the camera to the ball's centre, ball radii";
  static constexpr int kNewtonSteps = 5;
  /// q, √(1 − q²), κ, τ of the comment above, and the least z/|d| that is covered.
  double nearness = 0, rim_cosine = 1, incidence = 1, tangent = 0, covered_from = -2;
};

}  // namespace welkin::sphere
