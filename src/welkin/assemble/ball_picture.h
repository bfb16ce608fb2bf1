#pragma once

#include "welkin/sphere/mirror_ball.h"

namespace welkin {

/// A photograph that a mirror ball is a part of: sphere::MirrorBall in a circle of the chart. Call update()
/// after changing a parameter.
struct BallPicture {
  static constexpr const char* kName = "ball-picture";
  static constexpr int kCharts = 1;
  double distance = std::numeric_limits<double>::infinity();  ///< of the ball
  double x = 0.5, y = 0.5;                                    ///< its centre in the chart
  double across = 0.5, down = 0.5;                            ///< its radius, chart widths and heights

  void update() { ball = sphere::MirrorBall(distance); }

  template <class Visitor>
  void visit_parameters(Visitor&& visit) {
    visit("distance", distance, 1.01, std::numeric_limits<double>::infinity(), "of the camera, ball radii");
    visit("x", x, 0.0, 1.0, "the ball's centre, chart widths");
    visit("y", y, 0.0, 1.0, "the ball's centre, chart heights");
    visit("across", across, 1e-6, 0.5, "the ball's radius, chart widths");
    visit("down", down, 1e-6, 0.5, "the ball's radius, chart heights");
    update();
  }

  double aspect() const { return down / across; }

  template <class T>
  Vec3<T> to_sphere(int chart, T u, T v) const {
    return ball.to_sphere(chart, in_square(u, x, across), in_square(v, y, down));
  }
  template <class T>
  sphere::ChartPoint<T> from_sphere(const Vec3<T>& d) const {
    const sphere::ChartPoint<T> p = ball.from_sphere(d);
    const T two = constant<T>(2), one = constant<T>(1);
    return {p.chart, constant<T>(x) + constant<T>(across) * (two * p.u - one),
            constant<T>(y) + constant<T>(down) * (two * p.v - one)};
  }
  template <class T>
  T solid_angle_density(int chart, T u, T v) const {
    return constant<T>(1 / (4 * across * down)) *
           ball.solid_angle_density(chart, in_square(u, x, across), in_square(v, y, down));
  }
  template <class T>
  Mask<T> valid(int chart, T u, T v) const {
    return ball.valid(chart, in_square(u, x, across), in_square(v, y, down));
  }
  template <class T>
  Mask<T> covers(const Vec3<T>& d) const {
    return ball.covers(d);
  }
  double coverage() const { return ball.coverage(); }

 private:
  /// A position of the chart in the square around the ball.
  template <class T>
  static T in_square(T position, double centre, double radius) {
    return constant<T>(0.5) + constant<T>(0.5 / radius) * (position - constant<T>(centre));
  }

  sphere::MirrorBall ball;
};

}  // namespace welkin
