#include "welkin/lookup/cone_shapes.h"

#include <algorithm>
#include <cmath>

#include "welkin/base/error.h"
#include "welkin/lobe/zonal.h"
#include "welkin/lookup/tangent_plane.h"
#include "welkin/math/vec_precision.h"

namespace welkin {
namespace {

bool is_finite(const Vec3d& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// The cone of second moments Σ in a plane.
EllipticalCone cone_of(const TangentPlane& plane, const Covariance& sigma) {
  const Ellipse ellipse = ellipse_of(sigma);
  const Vec3d axis = std::cos(ellipse.angle) * plane.right + std::sin(ellipse.angle) * plane.down;
  const float narrow = static_cast<float>(ellipse.narrow);
  return {to_float(plane.normal), to_float(axis), std::max(narrow, static_cast<float>(ellipse.wide)), narrow};
}

/// Σ of a parallelogram of these sides.
Covariance covariance_of_sides(const PlanePoint& a, const PlanePoint& b) {
  return {(a.x * a.x + b.x * b.x) / 12, (a.x * a.y + b.x * b.y) / 12, (a.y * a.y + b.y * b.y) / 12};
}

}  // namespace

EllipticalCone isotropic_cone(const Vec3d& direction, double sigma) {
  require(is_finite(direction) && length(direction) > 0, "a cone's direction is zero or not finite");
  const TangentPlane plane(normalize(direction));
  const float width = static_cast<float>(sigma);
  const EllipticalCone cone{to_float(plane.normal), to_float(plane.right), width, width};
  const std::string fault = fault_of(cone);
  require(fault.empty(), fault.c_str());
  return cone;
}

EllipticalCone cone_of(const QuadCone& quad) {
  const std::string fault = fault_of(quad);
  require(fault.empty(), fault.c_str());
  Vec3d sum{0, 0, 0};
  for (const Vec3d& corner : quad.corners) sum = sum + normalize(corner);
  const TangentPlane plane(normalize(sum));
  PlanePoint p[4];
  for (std::size_t i = 0; i < 4; ++i) p[i] = plane.logarithm(normalize(quad.corners[i]));
  // Means of opposite sides.
  const PlanePoint across{0.5 * (p[1].x - p[0].x + p[2].x - p[3].x),
                          0.5 * (p[1].y - p[0].y + p[2].y - p[3].y)};
  const PlanePoint along{0.5 * (p[3].x - p[0].x + p[2].x - p[1].x),
                         0.5 * (p[3].y - p[0].y + p[2].y - p[1].y)};
  return cone_of(plane, covariance_of_sides(across, along));
}

EllipticalCone cone_of(const RayDifferential& ray) {
  const double far = length(ray.direction);
  require(far > 0 && std::isfinite(far), "a ray's direction is zero or not finite");
  require(is_finite(ray.right) && is_finite(ray.down), "a ray's differential is not finite");
  const TangentPlane plane((1 / far) * ray.direction);
  // What changes the length of the direction lies along the normal, and drops out.
  const auto side = [&](const Vec3d& change) {
    return PlanePoint{dot(plane.right, change) / far, dot(plane.down, change) / far};
  };
  return cone_of(plane, covariance_of_sides(side(ray.right), side(ray.down)));
}

QuadCone cone_of_area(const MapFrame& picture, int chart, const PictureArea& area) {
  const Matrix3 to_world = transpose(picture.orientation);
  const double u = area.x / picture.size.width, v = area.y / picture.size.height;
  const double half_u = 0.5 * area.width / picture.size.width,
               half_v = 0.5 * area.height / picture.size.height;
  require(half_u >= 0 && half_v >= 0, "an area's width or height is negative or not a number");
  require(u - half_u >= -1 && u + half_u <= 2 && v - half_v >= -1 && v + half_v <= 2,
          "an area lies more than a chart's side outside its picture");
  QuadCone cone;
  const double signs[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  for (std::size_t i = 0; i < 4; ++i) {
    cone.corners[i] = to_world * picture.parameterization.to_sphere(chart, u + signs[i][0] * half_u,
                                                                    v + signs[i][1] * half_v);
  }
  const std::string fault = fault_of(cone);
  require(fault.empty(), fault.c_str());
  return cone;
}

EllipticalCone blurred(const EllipticalCone& cone, double lobe_sigma) {
  const std::string fault = fault_of(cone);
  require(fault.empty(), fault.c_str());
  require(lobe_sigma >= 0 && std::isfinite(lobe_sigma), "a lobe's width is not a number of radians");
  EllipticalCone wider = cone;
  wider.narrow = static_cast<float>(std::hypot(static_cast<double>(cone.narrow), lobe_sigma));
  wider.wide =
      std::max(wider.narrow, static_cast<float>(std::hypot(static_cast<double>(cone.wide), lobe_sigma)));
  return wider;
}

double lobe_sigma_of(const lobe::AnyLobe& lobe) {
  const double mean_cosine = lobe::zonal_coefficients(lobe, 1)[1];
  const double least = std::exp(-kWidestSigma * kWidestSigma);
  return std::sqrt(-std::log(clamp(mean_cosine, least, 1.0)));
}

}  // namespace welkin
