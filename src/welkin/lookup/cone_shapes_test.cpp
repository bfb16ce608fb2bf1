#include "welkin/lookup/cone_shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "welkin/base/error.h"
#include "welkin/lookup/tangent_plane.h"
#include "welkin/map/map_cases.h"
#include "welkin/math/angles.h"

namespace welkin::test {
namespace {

using sphere::AnyParameterization;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

double value(float x) {
  return static_cast<double>(x);
}

Vec3d wide_axis(const EllipticalCone& cone) {
  return normalize(Vec3d{value(cone.axis.x), value(cone.axis.y), value(cone.axis.z)});
}

/// A pixel of a pinhole camera that looks along +Z: from (x, y) on the plane z = 1.
QuadCone pinhole_pixel(double x, double y, double width, double height) {
  return {{Vec3d{x, y, 1}, Vec3d{x + width, y, 1}, Vec3d{x + width, y + height, 1}, Vec3d{x, y + height, 1}}};
}

/// Second moments of the directions of that pixel about its middle, each part of the plane alike, as a
/// picture's pixel weighs what it sees.
Ellipse true_moments(double x, double y, double width, double height) {
  constexpr int kSteps = 100;
  const EllipticalCone cone = cone_of(pinhole_pixel(x, y, width, height));
  const TangentPlane plane(
      normalize(Vec3d{value(cone.direction.x), value(cone.direction.y), value(cone.direction.z)}));
  PlanePoint mean{0, 0};
  Covariance c{0, 0, 0};
  for (int i = 0; i < kSteps * kSteps; ++i) {
    const double px = x + width * (i % kSteps + 0.5) / kSteps, py = y + height * (i / kSteps + 0.5) / kSteps;
    const PlanePoint p = plane.logarithm(normalize(Vec3d{px, py, 1}));
    constexpr double kShare = 1.0 / (kSteps * kSteps);
    mean = {mean.x + kShare * p.x, mean.y + kShare * p.y};
    c = {c.xx + kShare * p.x * p.x, c.xy + kShare * p.x * p.y, c.yy + kShare * p.y * p.y};
  }
  return ellipse_of({c.xx - mean.x * mean.x, c.xy - mean.x * mean.y, c.yy - mean.y * mean.y});
}

TEST(ConeShapes, HaveTheSecondMomentsOfPerspectivePixels) {
  struct Case {
    double width, height, tolerance;
  };
  // The tolerances of the header.
  for (const Case& each :
       {Case{0.002, 0.002, 1e-3}, Case{0.03, 0.01, 1e-3}, Case{0.1, 0.05, 1e-3}, Case{0.5, 0.5, 2.1e-2}}) {
    for (const double x : {-each.width / 2, 0.3, 0.9}) {
      for (const double y : {-each.height / 2, -0.7}) {
        if (each.width > 0.2 && x > 0) continue;
        const EllipticalCone cone = cone_of(pinhole_pixel(x, y, each.width, each.height));
        const Ellipse truth = true_moments(x, y, each.width, each.height);
        EXPECT_NEAR(value(cone.wide) / truth.wide, 1, each.tolerance)
            << each.width << " at " << x << " " << y;
        EXPECT_NEAR(value(cone.narrow) / truth.narrow, 1, each.tolerance) << each.width;
      }
    }
  }
}

TEST(ConeShapes, OfASmallPixelAreThoseOfItsRayDifferentials) {
  const double step = 1e-3;
  for (const double x : {0.0, 0.4, -1.3}) {
    const EllipticalCone quad = cone_of(pinhole_pixel(x - step / 2, 0.2 - step, step, 2 * step));
    const EllipticalCone ray =
        cone_of(RayDifferential{{7 * x, 7 * 0.2, 7}, {7 * step, 0, 0}, {0, 7 * 2 * step, 0}});
    EXPECT_NEAR(value(quad.wide) / value(ray.wide), 1, 1e-4);
    EXPECT_NEAR(value(quad.narrow) / value(ray.narrow), 1, 1e-4);
    EXPECT_LT(angle_between(wide_axis(quad), wide_axis(ray)), 2e-3);
  }
}

TEST(ConeShapes, OfASquareLeanBackAsTheySeeAFloorAtGrazingAngles) {
  // A floor 1 below, seen far off: a pixel's cone is as wide as it is high, whatever the distance.
  const EllipticalCone cone = cone_of(RayDifferential{{0, -1, 20}, {0.01, 0, 0}, {0, 0, 4.0}});
  EXPECT_NEAR(value(cone.wide), 4.0 * 1 / (401 * std::sqrt(12)), 1e-5);
  EXPECT_NEAR(std::fabs(wide_axis(cone).y), 20 / std::sqrt(401), 1e-6);
}

TEST(ConeShapes, WithoutAreaHaveNoWidthAcross) {
  const EllipticalCone line =
      cone_of(QuadCone{{Vec3d{-1, 0, 9}, Vec3d{1, 0, 9}, Vec3d{1, 0, 9}, Vec3d{-1, 0, 9}}});
  EXPECT_EQ(fault_of(line), "");
  EXPECT_EQ(line.narrow, 0.0f);
  EXPECT_NEAR(value(line.wide), 2 * std::atan(1.0 / 9) / std::sqrt(12), 1e-6);
  const EllipticalCone point =
      cone_of(QuadCone{{Vec3d{1, 2, 3}, Vec3d{1, 2, 3}, Vec3d{1, 2, 3}, Vec3d{1, 2, 3}}});
  EXPECT_EQ(fault_of(point), "");
  EXPECT_NEAR(value(point.wide), 0, 1e-7);
  const EllipticalCone triangle =
      cone_of(QuadCone{{Vec3d{0, 0, 1}, Vec3d{0.1, 0, 1}, Vec3d{0, 0.1, 1}, Vec3d{0, 0.1, 1}}});
  EXPECT_EQ(fault_of(triangle), "");
  EXPECT_GT(triangle.narrow, 0.0f);
}

TEST(ConeShapes, OfTexelsCoverTheWorldOnce) {
  // Σ solid angles of all pixels' cones ≈ 4π: a box of σ's is √12σ wide, and areas multiply.
  for (const std::string spec : {"latlong", "cube", "octahedral", "healpix"}) {
    const Map map = cases::make_map(spec, 64);
    double sum = 0;
    for (int chart = 0; chart < map.charts(); ++chart) {
      for (int y = 0; y < map.height(); ++y) {
        for (int x = 0; x < map.width(); ++x) {
          const EllipticalCone cone = cone_of(cone_of_area(map, chart, {.x = x + 0.5, .y = y + 0.5}));
          EXPECT_EQ(fault_of(cone), "");
          sum += 12 * value(cone.wide) * value(cone.narrow);
        }
      }
    }
    EXPECT_NEAR(sum / (4 * kPi), 1, 0.01) << spec;
  }
}

TEST(ConeShapes, OfPicturesLieInTheWorld) {
  MapFrame frame(AnyParameterization::make("latlong"), {64, 32}, rotation_from_yaw_pitch_roll(40, 20, 10));
  const EllipticalCone cone =
      cone_of(cone_of_area(frame, 0, {.x = 40, .y = 20, .width = 1e-3, .height = 1e-3}));
  const Vec3d want = transpose(frame.orientation) * frame.parameterization.to_sphere(0, 40.0 / 64, 20.0 / 32);
  EXPECT_LT(angle_between({value(cone.direction.x), value(cone.direction.y), value(cone.direction.z)}, want),
            1e-6);
}

TEST(ConeShapes, ComposeByAddingVariances) {
  const EllipticalCone cone{{0, 0, 1}, {1, 0, 0}, 0.4f, 0.03f};
  const EllipticalCone wider = blurred(cone, 0.04);
  EXPECT_NEAR(value(wider.narrow), 0.05, 1e-7);
  EXPECT_NEAR(value(wider.wide), std::hypot(0.4, 0.04), 1e-7);
  EXPECT_EQ(blurred(cone, 0).narrow, cone.narrow);
  EXPECT_THROW(blurred(cone, -0.1), Error);
  EXPECT_THROW(blurred(cone, kNaN), Error);
}

TEST(ConeShapes, OfLobesHaveTheirMeanCosine) {
  EXPECT_EQ(lobe_sigma_of(lobe::AnyLobe::make("ggx,roughness=0")), 0);
  // The mean cosine of a Lambertian lobe is 2/3; that of a vMF lobe 1/tanh κ − 1/κ.
  EXPECT_NEAR(lobe_sigma_of(lobe::AnyLobe::make("lambert")), std::sqrt(std::log(1.5)), 1e-6);
  double before = 0;
  for (const char* spec : {"ggx,roughness=0.2", "ggx,roughness=0.4", "ggx,roughness=0.8"}) {
    const double sigma = lobe_sigma_of(lobe::AnyLobe::make(spec));
    EXPECT_GT(sigma, before);
    before = sigma;
  }
}

TEST(ConeShapes, RefuseWhatMeansNothing) {
  const Vec3d z{0, 0, 1};
  EXPECT_THROW(cone_of(QuadCone{{z, z, z, Vec3d{0, 0, 0}}}), Error);
  EXPECT_THROW(cone_of(QuadCone{{z, z, z, Vec3d{0, kNaN, 1}}}), Error);
  EXPECT_THROW(cone_of(QuadCone{{z, z, Vec3d{0, 0, -1}, Vec3d{0, 0, -1}}}), Error);
  EXPECT_THROW(cone_of(QuadCone{{Vec3d{1, 0, 0}, Vec3d{-1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, -1, 0}}}), Error);
  EXPECT_THROW(cone_of(RayDifferential{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), Error);
  EXPECT_THROW(cone_of(RayDifferential{z, {kNaN, 0, 0}, {0, 1, 0}}), Error);
  EXPECT_THROW(isotropic_cone(z, -1), Error);
  EXPECT_THROW(isotropic_cone(z, kNaN), Error);
  EXPECT_THROW(isotropic_cone({0, 0, 0}, 1), Error);
  const MapFrame frame(AnyParameterization::make("cube"), {8, 8});
  EXPECT_THROW(cone_of_area(frame, 6, {.x = 4, .y = 4}), Error);
  EXPECT_THROW(cone_of_area(frame, 0, {.x = 4, .y = 4, .width = -1}), Error);
  EXPECT_THROW(cone_of_area(frame, 0, {.x = kNaN, .y = 4}), Error);
  EXPECT_THROW(cone_of_area(frame, 0, {.x = 1000, .y = 4}), Error);
}

}  // namespace
}  // namespace welkin::test
