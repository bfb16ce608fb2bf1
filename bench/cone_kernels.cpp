#include "cone_kernels.h"

#include <algorithm>
#include <cmath>

#include "welkin/lookup/cone_reference.h"
#include "welkin/lookup/cone_shapes.h"
#include "welkin/lookup/gaussian_boxes.h"
#include "welkin/lookup/probe_row.h"
#include "welkin/lookup/texel_shape.h"
#include "welkin/math/angles.h"

namespace welkin::bench {
namespace {

/// Points along a texel's side of references.
constexpr int kPoints = 2;

Vec3d wide(const Vec3<float>& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}
double wide(float x) {
  return static_cast<double>(x);
}

TangentPlane plane_of(const EllipticalCone& cone) {
  return TangentPlane(normalize(wide(cone.direction)), wide(cone.axis));
}

std::vector<double> circle_mean(const Map& map, const EllipticalCone& cone, double sigma) {
  return look_up_reference(map, isotropic_cone(wide(cone.direction), sigma), kPoints);
}

/// A rectangle of texels about a cone.
QuadCone texel_rectangle(const TangentPlane& plane, const TexelSides& sides, double half_x, double half_y) {
  QuadCone quad;
  const double signs[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  for (std::size_t i = 0; i < 4; ++i) {
    quad.corners[i] =
        plane.exponential(sides.to_plane(PlanePoint{signs[i][0] * half_x, signs[i][1] * half_y}));
  }
  return quad;
}

TexelSides sides_of(const Map& map, const TangentPlane& plane) {
  return texel_sides(map.parameterization, {map.width(), map.height()}, plane);
}

}  // namespace

std::vector<double> own_trilinear(const Map& map, const EllipticalCone& cone) {
  return circle_mean(map, cone, std::sqrt(wide(cone.wide) * wide(cone.narrow)));
}

std::vector<double> own_longer_side(const Map& map, const EllipticalCone& cone) {
  return circle_mean(map, cone, std::sqrt(3.0) * wide(cone.wide));
}

std::vector<double> own_box(const Map& map, const EllipticalCone& cone) {
  const TangentPlane plane = plane_of(cone);
  const TexelSides sides = sides_of(map, plane);
  const double area = std::fabs(sides.right.x * sides.down.y - sides.right.y * sides.down.x);
  const double half = std::max(0.5, 0.5 * std::sqrt(12 * wide(cone.wide) * wide(cone.narrow) / area));
  return look_up_reference(map, texel_rectangle(plane, sides, half, half), 4);
}

OwnMean own_boxes(int count) {
  return [count](const Map& map, const EllipticalCone& cone) {
    const TangentPlane plane = plane_of(cone);
    const TexelSides sides = sides_of(map, plane);
    const Covariance texels = sides.to_texels(
        Covariance{wide(cone.wide) * wide(cone.wide), 0, wide(cone.narrow) * wide(cone.narrow)});
    std::vector<double> sum(static_cast<std::size_t>(map.channels()));
    for (int k = 0; k < count; ++k) {
      const GaussianBox& box = kGaussianBoxes[count - 1][k];
      const auto mean =
          look_up_reference(map,
                            texel_rectangle(plane, sides, std::max(0.5, box.half * std::sqrt(texels.xx)),
                                            std::max(0.5, box.half * std::sqrt(texels.yy))),
                            4);
      for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += box.share * mean[c];
    }
    return sum;
  };
}

std::vector<double> own_probes(const Map& map, const EllipticalCone& cone) {
  const ProbeRow row = probe_row(cone.wide, cone.narrow, 16);
  const TangentPlane plane = plane_of(cone);
  std::vector<ConeWeight> weights;
  for (int i = 0; i < row.count; ++i) {
    weights.emplace_back(isotropic_cone(plane.exponential({wide(row.angle[static_cast<std::size_t>(i)]), 0}),
                                        wide(row.sigma)));
  }
  return weighted_mean(
      map,
      [&](const Vec3d& d) {
        double sum = 0;
        if (angle_between(d, plane.normal) > 6 * wide(cone.wide)) return sum;
        for (std::size_t i = 0; i < weights.size(); ++i) sum += wide(row.share[i]) * weights[i](d);
        return sum;
      },
      kPoints);
}

std::vector<double> own_ewa(const Map& map, const EllipticalCone& cone) {
  const TangentPlane plane = plane_of(cone);
  return weighted_mean(
      map,
      [&](const Vec3d& d) {
        if (angle_between(d, plane.normal) > 7 * wide(cone.wide)) return 0.0;
        const PlanePoint p = plane.logarithm(d);
        const double x = p.x / wide(cone.wide), y = p.y / wide(cone.narrow);
        return std::exp(-0.5 * (x * x + y * y));
      },
      kPoints);
}

std::vector<double> own_cone(const Map& map, const EllipticalCone& cone) {
  return look_up_reference(map, cone, kPoints);
}

}  // namespace welkin::bench
