#include <algorithm>
#include <cmath>
#include <memory>

#include "welkin/base/error.h"
#include "welkin/scene/shapes.h"

namespace welkin::scene {
namespace {

constexpr int kAxisSteps = 2048;

/// A curve by its length, with axes across it that don't turn about it.
struct Axis {
  std::vector<Vec3d> points, tangents, across;
  std::vector<double> lengths;
};

struct AxisFrame {
  Vec3d point, tangent, across, bend;  // bend: how the tangent changes with length
};

Axis axis_of(const std::function<Vec3d(double t)>& curve) {
  Axis axis;
  for (int i = 0; i <= kAxisSteps; ++i) {
    const double t = static_cast<double>(i) / kAxisSteps;
    axis.points.push_back(curve(t));
    axis.lengths.push_back(i == 0 ? 0
                                  : axis.lengths.back() + length(axis.points.back() - axis.points.end()[-2]));
    constexpr double kStep = 1e-4;
    const Vec3d way = curve(std::min(t + kStep, 1.0)) - curve(std::max(t - kStep, 0.0));
    require(length(way) > 0 && std::isfinite(length(way)), "a tube's axis stands still nowhere");
    axis.tangents.push_back(normalize(way));
    // The axis across is carried along: its part along the tangent is taken off.
    Vec3d side = i > 0 ? axis.across.back() : Vec3d{1, 0, 0};
    if (i == 0 && std::abs(axis.tangents[0].x) > 0.9) side = {0, 0, 1};
    const Vec3d& tangent = axis.tangents.back();
    axis.across.push_back(normalize(side - dot(side, tangent) * tangent));
  }
  return axis;
}

AxisFrame frame_at(const Axis& axis, double along) {
  const auto past = std::upper_bound(axis.lengths.begin(), axis.lengths.end(), along);
  const auto i = static_cast<std::size_t>(
      std::clamp<std::ptrdiff_t>(past - axis.lengths.begin() - 1, 0, kAxisSteps - 1));
  const double step = axis.lengths[i + 1] - axis.lengths[i];
  const double f = (along - axis.lengths[i]) / step, inside = std::clamp(f, 0.0, 1.0);
  AxisFrame frame;
  frame.tangent = normalize((1 - inside) * axis.tangents[i] + inside * axis.tangents[i + 1]);
  frame.point =
      (1 - inside) * axis.points[i] + inside * axis.points[i + 1] + ((f - inside) * step) * frame.tangent;
  const Vec3d side = (1 - inside) * axis.across[i] + inside * axis.across[i + 1];
  frame.across = normalize(side - dot(side, frame.tangent) * frame.tangent);
  frame.bend = f == inside ? (1 / step) * (axis.tangents[i + 1] - axis.tangents[i]) : Vec3d{0, 0, 0};
  return frame;
}

/// A profile about an axis.
Mesh swept(const std::function<AxisFrame(double along)>& axis, const Profile& profile, int columns,
           int rows) {
  return grid_mesh(
      [&](double u, double v) {
        // Where it closes, vertices are the same to the bit, or rays go through between them.
        const double t = 1 - v, azimuth = u < 1 ? 2 * kPi * u : 0;
        ProfilePoint at = profile(t);
        if (at.radius < 1e-12) at.radius = 0;
        constexpr double kStep = 1e-5;
        const ProfilePoint before = profile(std::max(t - kStep, 0.0)),
                           after = profile(std::min(t + kStep, 1.0));
        const AxisFrame frame = axis(at.along);
        const Vec3d other = cross(frame.across, frame.tangent);
        const Vec3d out = -std::sin(azimuth) * frame.across - std::cos(azimuth) * other;
        // In a bend the inner side is shorter than the axis, the outer longer.
        const double stretch = 1 - at.radius * dot(out, frame.bend);
        const Vec3d normal =
            (stretch * (after.along - before.along)) * out - (after.radius - before.radius) * frame.tangent;
        return GridPoint{frame.point + at.radius * out, normal};
      },
      columns, rows);
}

}  // namespace

std::function<Vec3d(double t)> curve_through(std::vector<Vec3d> points) {
  require(points.size() >= 2, "a curve goes through two points at least");
  return [points = std::move(points)](double t) {
    const double last = static_cast<double>(points.size() - 1), place = std::clamp(t, 0.0, 1.0) * last;
    const auto i = static_cast<std::size_t>(std::min(place, last - 1));
    const double f = place - static_cast<double>(i);
    const Vec3d &b = points[i], &c = points[i + 1];
    // Past the ends the points go on as they came.
    const Vec3d a = i > 0 ? points[i - 1] : 2.0 * b - c;
    const Vec3d d = i + 2 < points.size() ? points[i + 2] : 2.0 * c - b;
    const Vec3d from = 0.5 * (c - a), to = 0.5 * (d - b);
    const double f2 = f * f, f3 = f2 * f;
    return (2 * f3 - 3 * f2 + 1) * b + (f3 - 2 * f2 + f) * from + (3 * f2 - 2 * f3) * c + (f3 - f2) * to;
  };
}

Profile rod_profile(double length, double first, double last) {
  require(length >= 0 && first > 0 && last > 0, "a rod has a radius, and no negative length");
  // Each part takes a share of t in proportion to its own length, so that rows lie evenly.
  const double first_arc = kPi / 2 * first, last_arc = kPi / 2 * last, whole = first_arc + length + last_arc;
  return [=](double t) -> ProfilePoint {
    const double at = t * whole;
    if (at < first_arc) {
      const double angle = at / first - kPi / 2;
      return {first * std::sin(angle), first * std::cos(angle)};
    }
    if (at <= first_arc + length) {
      const double f = length > 0 ? (at - first_arc) / length : 0;
      return {at - first_arc, first + f * (last - first)};
    }
    const double angle = std::min((at - first_arc - length) / last, kPi / 2);
    return {length + last * std::sin(angle), last * std::cos(angle)};
  };
}

Mesh lathe_mesh(const Profile& profile, int columns, int rows) {
  Mesh mesh = swept(
      [](double along) {
        return AxisFrame{{0, along, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 0}};
      },
      profile, columns, rows);
  mesh.name = "lathe";
  return mesh;
}

Mesh tube_mesh(const std::function<Vec3d(double t)>& axis, const Profile& profile, int columns, int rows) {
  const Axis line = axis_of(axis);
  Mesh mesh = swept([&](double along) { return frame_at(line, along); }, profile, columns, rows);
  mesh.name = "tube";
  return mesh;
}

double curve_length(const std::function<Vec3d(double t)>& curve) {
  return axis_of(curve).lengths.back();
}

}  // namespace welkin::scene
