#include "welkin/light/ellipse_fit.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace welkin {
namespace {

/// Misfits closer than this are alike: 1.7 % of the texels' values, RMS.
constexpr double kAlike = 3e-4;

FittedEllipse ellipse_from(const std::vector<double>& p, double fixed) {
  // Beyond these, neither the texels nor the numbers mean anything.
  const auto axis = [](double logarithm) { return std::exp(std::clamp(logarithm, -4.0, 6.0)); };
  if (p.size() == 2) return {p[0], p[1], fixed, fixed, 0};
  if (p.size() == 3) return {p[0], p[1], axis(p[2]), axis(p[2]), 0};
  return {p[0], p[1], axis(p[2]), axis(p[3]), p[4]};
}

/// Solves a symmetric system of n ≤ 5 in place, by elimination with pivots on the diagonal; false where it is
/// singular.
bool solve(std::vector<double>& a, std::vector<double>& b, std::size_t n) {
  for (std::size_t k = 0; k < n; ++k) {
    if (!(a[k * n + k] > 1e-30)) return false;
    for (std::size_t i = k + 1; i < n; ++i) {
      const double factor = a[i * n + k] / a[k * n + k];
      for (std::size_t j = k; j < n; ++j) a[i * n + j] -= factor * a[k * n + j];
      b[i] -= factor * b[k];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t j = k + 1; j < n; ++j) b[k] -= a[k * n + j] * b[j];
    b[k] /= a[k * n + k];
  }
  return true;
}

double sum_of_squares(const std::vector<double>& values) {
  return std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
}

}  // namespace

LightPlane::LightPlane(const Vec3d& middle) : middle_(middle) {
  right_ = normalize(cross(std::fabs(middle.y) < 0.9 ? Vec3d{0, 1, 0} : Vec3d{1, 0, 0}, middle));
  up_ = cross(middle, right_);
}

FitPoint LightPlane::point(const Vec3d& d) const {
  const double stretch = std::sqrt(2 / std::max(1 + dot(d, middle_), 1e-12));
  return {stretch * dot(d, right_), stretch * dot(d, up_)};
}

Vec3d LightPlane::direction(const FitPoint& p) const {
  const double square = std::min(p.x * p.x + p.y * p.y, 4.0), stretch = std::sqrt(1 - square / 4);
  return normalize(stretch * p.x * right_ + stretch * p.y * up_ + (1 - square / 2) * middle_);
}

void EllipseFit::begin_texel(double value, double width) {
  widths_.push_back(width / side_);
  values_.push_back(value);
  weights_.push_back(0);
  squares_ += value * value;
}

void EllipseFit::add_point(const FitPoint& point, double weight) {
  points_.push_back({point.x / side_, point.y / side_, weight});
  weights_.back() += weight;
}

std::vector<double> EllipseFit::residuals(const Parameters& p, double fixed) const {
  const FittedEllipse e = ellipse_from(p, fixed);
  const double c = std::cos(e.angle), s = std::sin(e.angle);
  const std::size_t points = static_cast<std::size_t>(parts_ * parts_);
  // How far a point lies inside, of the width that it stands for. Beyond `rim` of the edge, in units of the
  // distance to it, that is 0 or 1.
  const auto inside = [&](const Point& point, double width, double rim) {
    const double dx = point.x - e.x, dy = point.y - e.y;
    const double x = (c * dx + s * dy) / e.a, y = (c * dy - s * dx) / e.b;
    const double square = x * x + y * y;
    if (square >= (1 + rim) * (1 + rim)) return 0.0;
    if (square < 1e-12 || (rim < 1 && square <= (1 - rim) * (1 - rim))) return 1.0;
    const double radius = std::sqrt(square), xa = x / e.a, yb = y / e.b;
    const double slope = std::sqrt(xa * xa + yb * yb) / radius;
    return std::clamp(0.5 - (radius - 1) / (slope * width), 0.0, 1.0);
  };
  std::vector<double> covered(values_.size());
  double product = 0, square = 0;
  for (std::size_t i = 0; i < values_.size(); ++i) {
    // `slope` is at most 1 over the shorter half axis.
    const double width = widths_[i] / parts_, rim = width / (2 * std::min(e.a, e.b));
    for (std::size_t k = i * points; k < (i + 1) * points; ++k)
      covered[i] += points_[k].weight * inside(points_[k], width, rim);
    covered[i] /= weights_[i];
    product += covered[i] * values_[i];
    square += covered[i] * covered[i];
  }
  // The radiance that fits best is linear.
  const double radiance = square > 0 ? product / square : 0;
  for (std::size_t i = 0; i < values_.size(); ++i) covered[i] = values_[i] - radiance * covered[i];
  return covered;
}

/// Levenberg and Marquardt's, with derivatives by differences.
double EllipseFit::fit(Parameters& p, double fixed) const {
  const std::size_t n = p.size();
  std::vector<double> now = residuals(p, fixed);
  double misfit = sum_of_squares(now);
  double damping = 1e-3;
  for (int step = 0; step < 40; ++step) {
    std::vector<std::vector<double>> slopes(n);
    constexpr double kDelta = 1e-3;
    for (std::size_t j = 0; j < n; ++j) {
      Parameters moved = p;
      moved[j] += kDelta;
      slopes[j] = residuals(moved, fixed);
      for (std::size_t i = 0; i < now.size(); ++i) slopes[j][i] = (slopes[j][i] - now[i]) / kDelta;
    }
    std::vector<double> normal(n * n), gradient(n);
    for (std::size_t j = 0; j < n; ++j) {
      gradient[j] = -std::inner_product(slopes[j].begin(), slopes[j].end(), now.begin(), 0.0);
      for (std::size_t k = 0; k < n; ++k)
        normal[j * n + k] = std::inner_product(slopes[j].begin(), slopes[j].end(), slopes[k].begin(), 0.0);
    }
    bool better = false;
    double gained = 0;
    for (int attempt = 0; attempt < 8 && !better; ++attempt) {
      std::vector<double> a = normal, change = gradient;
      for (std::size_t j = 0; j < n; ++j) a[j * n + j] = normal[j * n + j] * (1 + damping) + 1e-12 * squares_;
      if (!solve(a, change, n)) break;
      Parameters tried = p;
      for (std::size_t j = 0; j < n; ++j) tried[j] += std::clamp(change[j], -0.7, 0.7);
      std::vector<double> then = residuals(tried, fixed);
      const double sum = sum_of_squares(then);
      better = sum < misfit;
      damping = better ? damping / 5 : damping * 8;
      if (!better) continue;
      gained = misfit - sum;
      p = tried;
      now = std::move(then);
      misfit = sum;
    }
    if (!better || gained < 1e-9 * squares_) break;
  }
  return squares_ > 0 ? misfit / squares_ : 0;
}

EllipseFit::Result EllipseFit::disc(const FittedEllipse& start) const {
  Parameters p{start.x / side_, start.y / side_, std::log(std::max(start.a / side_, 0.1))};
  const double misfit = fit(p, 0);
  const FittedEllipse e = ellipse_from(p, 0);
  return {{e.x * side_, e.y * side_, e.a * side_, e.b * side_, 0}, misfit};
}

EllipseFit::Result EllipseFit::ellipse(const FittedEllipse& start) const {
  Parameters p{start.x / side_, start.y / side_, std::log(start.a / side_), std::log(start.b / side_),
               start.angle};
  const double misfit = fit(p, 0);
  const FittedEllipse e = ellipse_from(p, 0);
  return {{e.x * side_, e.y * side_, e.a * side_, e.b * side_, e.angle}, misfit};
}

EllipseFit::Result EllipseFit::disc_of(const Result& near, double radius) const {
  Parameters p{near.ellipse.x / side_, near.ellipse.y / side_};
  const double misfit = fit(p, radius / side_);
  return {{p[0] * side_, p[1] * side_, radius, radius, 0}, misfit};
}

std::optional<FittedEllipse> EllipseFit::largest_alike(const Result& disc) const {
  const double widest = side_ * std::max(1.0, *std::max_element(widths_.begin(), widths_.end()));
  if (disc.ellipse.a > 1.5 * widest) return std::nullopt;
  const double limit = disc.misfit + kAlike;
  if (disc_of(disc, 0.9 * disc.ellipse.a).misfit > limit) return std::nullopt;
  double fits = disc.ellipse.a, misses = 3 * widest;
  for (int step = 0; step < 12; ++step) {
    const double middle = (fits + misses) / 2;
    (disc_of(disc, middle).misfit <= limit ? fits : misses) = middle;
  }
  FittedEllipse largest = disc_of(disc, fits).ellipse;
  return largest;
}

}  // namespace welkin
