#include "welkin/sphere/frame.h"

#include <algorithm>
#include <cmath>

#include "welkin/math/gauss_legendre.h"

namespace welkin::sphere {
namespace {

constexpr double kDegree = kPi / 180;

double angle_from_axis(const Vec3d& d) {
  return std::atan2(std::hypot(d.x, d.y), d.z);
}

/// Of functions that vary over lengths of 1.
template <class Function>
double integrate(double from, double to, const Function& f) {
  const int pieces = std::clamp(static_cast<int>(std::ceil(to - from)), 1, 1000);
  const QuadratureRule& rule = gauss_rule(16);
  const double half = 0.5 * (to - from) / pieces;
  double sum = 0;
  for (int i = 0; i < pieces; ++i) {
    for (std::size_t k = 0; k < rule.nodes.size(); ++k)
      sum += rule.weights[k] * f(from + half * (2 * i + 1 + rule.nodes[k]));
  }
  return to > from ? half * sum : 0;
}

}  // namespace

Frame::Frame(Lens lens, double fov_degrees, double widest, double sees)
    : fov(fov_degrees), rim(sees), lens_(lens), widest_(widest), sees_(sees) {
  update();
}

void Frame::update() {
  find_size();
  // A sine, so that it is exactly 0 at 180°.
  rim_cosine_ = rim < 360 ? std::sin(kPi * (0.5 - rim / 360)) : -2;
  rim_distance_ = is_radial(lens_) ? distance_at(0.5 * rim) : 0;
  coverage_ = find_coverage();
}

std::string Frame::fault() const {
  if (vfov > 0 && dfov > 0) return "vfov and dfov are given, of which one says it";
  if ((vfov > 0 && vfov < kLeast) || (dfov > 0 && dfov < kLeast)) return "a field of view is at least 0.1°";
  if (ratio > 0 && ratio < 1e-3) return "aspect is at least 0.001";
  const auto degrees = [](double angle) { return std::to_string(std::lround(angle)) + "°"; };
  if (lens_ == Lens::pannini) {
    const double across = dfov > 0 || vfov > 0 ? 2 * angle_across() : fov;
    const double widest =
        std::min(shape.vertical > 0 ? 170 : 360.0, 2 * std::acos(-shape.distance) / kDegree - 10);
    if (!(across <= widest))
      return "the field of view is " + degrees(across) + " across; with this d and vertical it is at most " +
             degrees(widest);
  }
  const double x = half_width_ * (1 + 2 * std::fabs(right)), y = half_height_ * (1 + 2 * std::fabs(up));
  if (!(std::max(x, y) <= kLargest))
    return "so wide or high a frame shows next to nothing of what is ahead; take a smaller field of view";
  return "";
}

/// Of a radial lens, r at an angle in degrees.
double Frame::distance_at(double degrees) const {
  const double angle = degrees * kDegree;
  return radial_distance(lens_, Polar<double>{1, 0, std::sin(angle), std::cos(angle)});
}

/// From the axis to the right edge, before shifts, degrees.
double Frame::angle_across() const {
  return angle_from_axis(direction_at(lens_, shape, PlanePoint<double>{half_width_, 0})) / kDegree;
}

void Frame::find_size() {
  const double a = aspect(), half = 0.5 * (dfov > 0 ? dfov : vfov > 0 ? vfov : fov), angle = half * kDegree;
  if (dfov > 0) {
    half_height_ = is_radial(lens_) ? distance_at(half) / std::sqrt(1 + a * a) : height_of_diagonal(angle);
  } else if (vfov > 0) {
    half_height_ = is_radial(lens_) ? distance_at(half) : std::tan(angle);
  } else {
    half_width_ = is_radial(lens_) ? distance_at(half)
                  : lens_ == Lens::cylindrical
                      ? angle
                      : pannini_column(std::sin(angle), std::cos(angle), shape).across * std::sin(angle);
    half_height_ = half_width_ / a;
    return;
  }
  half_width_ = a * half_height_;
}

/// Half the height at which the corner is seen at this angle, by bisection.
double Frame::height_of_diagonal(double angle) const {
  double low = 0, high = kLargest;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    const PlanePoint<double> corner{aspect() * middle, middle};
    (angle_from_axis(direction_at(lens_, shape, corner)) < angle ? low : high) = middle;
  }
  return low;
}

/// The integral of the density over what is valid of the frame.
double Frame::find_coverage() const {
  const double x0 = 2 * half_width_ * (right - 0.5), x1 = 2 * half_width_ * (right + 0.5);
  const double y0 = 2 * half_height_ * (up - 0.5), y1 = 2 * half_height_ * (up + 0.5);
  if (is_radial(lens_))
    return edge(x0, y0, x1, y0) + edge(x1, y0, x1, y1) + edge(x1, y1, x0, y1) + edge(x0, y1, x0, y0);
  // Of each column dφ (sin β at the top − at the bottom); density · up at y = 0 is dφ/dx.
  const double most = lens_ == Lens::cylindrical ? kPi : 1e9;
  return integrate(std::max(x0, -most), std::min(x1, most), [&](double x) {
    const double scale = lens_ == Lens::cylindrical ? 1 : pannini_column(x, shape).up;
    const auto sine = [&](double y) { return y / std::hypot(scale, y); };
    return density_at(lens_, shape, PlanePoint<double>{x, 0}) * scale * (sine(y1) - sine(y0));
  });
}

/// ∮ (1 − cos θ) dψ along an edge, ψ the angle around the axis: by Green the solid angle inside. Past the rim
/// θ is that of the rim, so that only what is within it counts.
double Frame::edge(double x0, double y0, double x1, double y1) const {
  const double length = std::hypot(x1 - x0, y1 - y0), dx = (x1 - x0) / length, dy = (y1 - y0) / length;
  const double turn = x0 * dy - y0 * dx;
  if (turn == 0) return 0;
  const auto part = [&](double t) {
    const double x = x0 + t * dx, y = y0 + t * dy, r = std::sqrt(x * x + y * y);
    const double inner = std::min(r, rim_distance_);
    const Ray<double> ray = radial_ray(lens_, inner);
    const double sine = ray.sine_over_radius * inner;
    // 1 − cos θ without cancellation.
    const double height = ray.cosine > 0 ? sine * sine / (1 + ray.cosine) : 1 - ray.cosine;
    return turn * height / (r * r);
  };
  // Where the edge crosses the rim are kinks.
  const double b = x0 * dx + y0 * dy, square = rim_distance_ * rim_distance_ - turn * turn;
  const double root = square > 0 ? std::sqrt(square) : 0;
  const double first = std::clamp(-b - root, 0.0, length), second = std::clamp(-b + root, 0.0, length);
  return integrate(0, first, part) + integrate(first, second, part) + integrate(second, length, part);
}

}  // namespace welkin::sphere
