#include "welkin/assemble/edges.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "welkin/base/error.h"
#include "welkin/math/angles.h"

namespace welkin {
namespace {

/// Directions that the guess at a parameterization's edges is tested by, and how near to an edge none is.
constexpr int kProbes = 4000;
constexpr double kNear = 1e-6;
/// What a cap says of a direction on its edge, radians: rounding.
constexpr double kRound = 1e-9;

/// Spread evenly over the sphere, along a spiral.
Vec3d probe(int i) {
  const double y = 1 - (2 * i + 1.0) / kProbes, around = std::sqrt(1 - y * y);
  const double azimuth = i * kPi * (3 - std::sqrt(5.0));
  return {around * std::sin(azimuth), y, around * std::cos(azimuth)};
}

bool bound(const sphere::AnyParameterization& p, const std::vector<Cap>& caps) {
  for (int i = 0; i < kProbes; ++i) {
    const Vec3d d = probe(i);
    double depth = kPi;
    for (const Cap& cap : caps) depth = std::min(depth, cap.depth(d));
    if (std::fabs(depth) > kNear && p.covers(d) != (depth > 0)) return false;
  }
  return true;
}

/// The cap on whose edge an edge of the chart lies, if it is a circle; the chart's centre is inside.
std::optional<Cap> cap_along(const sphere::AnyParameterization& p, int edge) {
  const auto at = [&](double t) {
    const double far = edge < 2 ? 0.0 : 1.0;
    return edge % 2 == 0 ? p.to_sphere(0, far, t) : p.to_sphere(0, t, far);
  };
  const Vec3d a = at(0.1), b = at(0.5), c = at(0.9);
  const Vec3d normal = cross(b - a, c - a);
  if (length(normal) < kRound) return std::nullopt;  // a pole: one direction all along
  Vec3d axis = normalize(normal);
  if (dot(axis, p.to_sphere(0, 0.5, 0.5)) < dot(axis, a)) axis = -1.0 * axis;
  return Cap{axis, angle_between(axis, a)};
}

}  // namespace

double Cap::depth(const Vec3d& direction) const {
  return radius - angle_between(axis, direction);
}

std::vector<Cap> edges_of(const sphere::AnyParameterization& p) {
  if (p.whole_world()) return {};
  const double radius = std::acos(std::clamp(1 - p.coverage() / (2 * kPi), -1.0, 1.0));
  for (const Vec3d& axis : {Vec3d{0, 0, 1}, Vec3d{0, 1, 0}, Vec3d{0, -1, 0}}) {
    if (std::vector<Cap> one{{axis, radius}}; bound(p, one)) return one;
  }
  std::vector<Cap> caps;
  for (int edge = 0; edge < 4 && p.charts() == 1 && p.full_charts(); ++edge) {
    if (const auto cap = cap_along(p, edge)) caps.push_back(*cap);
  }
  if (!caps.empty() && bound(p, caps)) return caps;
  throw Error(
      ErrorKind::unsupported,
      "the edges of " + p.spec() + " are not those of a flat picture or a disc, and can't be feathered");
}

}  // namespace welkin
