/// What the sources say of single parameterizations: where the axes are, sampling rates, special cases.

#include "welkin/sphere/parameterization_cases.h"

namespace welkin::sphere {
namespace {

using namespace cases;

const double kHalfRoot = std::sqrt(0.5);

struct Row {
  Vec3d direction;
  int chart;
  double u, v;
};

/// Both ways: the direction is found at the position, and the position shows the direction.
template <class P>
void expect_rows(const P& p, const std::vector<Row>& rows) {
  for (const Row& row : rows) {
    const Vec3d d = normalize(row.direction);
    const ChartPoint<double> at = p.from_sphere(d);
    EXPECT_EQ(at.chart, row.chart) << P::kName << " " << d.x << " " << d.y << " " << d.z;
    EXPECT_NEAR(at.u, row.u, 1e-12) << P::kName << " " << d.x << " " << d.y << " " << d.z;
    EXPECT_NEAR(at.v, row.v, 1e-12) << P::kName << " " << d.x << " " << d.y << " " << d.z;
    EXPECT_LE(distance(p.to_sphere(row.chart, row.u, row.v), d), 1e-12)
        << P::kName << " " << row.u << " " << row.v;
  }
}

TEST(Axes, PanoramasHavePlusZInTheMiddleAndPlusXAQuarterToTheLeft) {
  expect_rows(LatLong{}, {{{1, 0, 0}, 0, 0.25, 0.5},
                          {{-1, 0, 0}, 0, 0.75, 0.5},
                          {{0, 0, 1}, 0, 0.5, 0.5},
                          {{0, 1, 1}, 0, 0.5, 0.25},
                          {{0, -1, 1}, 0, 0.5, 0.75}});
  expect_rows(EqualArea{}, {{{1, 0, 0}, 0, 0.25, 0.5},
                            {{-1, 0, 0}, 0, 0.75, 0.5},
                            {{0, 0, 1}, 0, 0.5, 0.5},
                            {{0, 1, 1}, 0, 0.5, 0.5 - 0.5 * kHalfRoot}});
  expect_rows(SkyLatLong{}, {{{1, 0, 0}, 0, 0.25, 1}, {{0, 0, 1}, 0, 0.5, 1}, {{0, 1, 1}, 0, 0.5, 0.5}});
  expect_rows(Cylinder{}, {{{1, 0, 0}, 0, 0.25, 0.5}, {{0, 1, 1}, 0, 0.5, 0}, {{0, -1, 1}, 0, 0.5, 1}});
  expect_rows(Mercator{}, {{{1, 0, 0}, 0, 0.25, 0.5},
                           {{0, std::sinh(kPi), 1}, 0, 0.5, 0},
                           {{0, -std::sinh(kPi / 2), 1}, 0, 0.5, 0.75}});
}

/// Azimuths grow to the right, from −180 at the left edge of the whole picture to 180 at its right edge.
TEST(Axes, WindowsArePartsOfTheLatLong) {
  expect_rows(Window<-90, 90, 45, -45>{}, {{{0, 0, 1}, 0, 0.5, 0.5},
                                           {{1, 0, 0}, 0, 0, 0.5},
                                           {{-1, 0, 0}, 0, 1, 0.5},
                                           {{0, 1, 1}, 0, 0.5, 0},
                                           {{-1, -1, 0}, 0, 1, 1}});
  expect_rows(Window<90, 270, 90, 0>{},
              {{{0, 0, -1}, 0, 0.5, 1}, {{-1, 0, 0}, 0, 0, 1}, {{1, 1, 0}, 0, 1, 0.5}});
  expect_rows(Vr180{}, {{{0, 0, 1}, 0, 0.5, 0.5}, {{0, 1, 1}, 0, 0.5, 0.25}, {{-1, 0, 1}, 0, 0.75, 0.5}});
  const auto check = [](const auto& p, double left, double right, double top, double bottom) {
    for (const Position& at : random_positions(LatLong::kCharts, 1000, -1, 2)) {
      const double u = (180 + left + at.u * (right - left)) / 360,
                   v = (90 - top + at.v * (top - bottom)) / 180;
      ASSERT_LE(distance(p.to_sphere(0, at.u, at.v), LatLong{}.to_sphere(0, u, v)), 3e-15);
    }
  };
  check(Window<-90, 90, 45, -45>{}, -90, 90, 45, -45);
  check(Window<90, 270, 60, -20>{}, 90, 270, 60, -20);
  check(Window<37, 38, 61, 60>{}, 37, 38, 61, 60);
  check(Window<130, 200, -30, -90>{}, 130, 200, -30, -90);
  check(LatLongWindow{}, -180, 180, 90, -90);
  check(Vr180{}, -90, 90, 90, -90);
  check(Vr180(220), -110, 110, 90, -90);
}

TEST(Coverage, OfWindowsIsTheirSolidAngle) {
  EXPECT_NEAR((Window<-90, 90, 30, -30>{}.coverage()), kPi, 1e-14);
  EXPECT_NEAR((Window<0, 360, 90, -90>{}.coverage()), 4 * kPi, 1e-14);
  EXPECT_NEAR((Window<0, 90, 90, 0>{}.coverage()), kPi / 2, 1e-14);
  EXPECT_NEAR(Vr180{}.coverage(), 2 * kPi, 1e-14);
  // Nothing lies outside of a whole world, at its seam and poles either.
  for (const Vec3d& d : special_directions()) EXPECT_TRUE((Window<0, 360, 90, -90>{}.covers(d)));
}

TEST(Axes, CameraPicturesHavePlusZInTheMiddleMinusXRightPlusYUp) {
  expect_rows(AngularMap{},
              {{{0, 0, 1}, 0, 0.5, 0.5}, {{-1, 0, 0}, 0, 0.75, 0.5}, {{0, 1, 0}, 0, 0.5, 0.25}});
  expect_rows(FisheyeEquidistant{},
              {{{0, 0, 1}, 0, 0.5, 0.5}, {{-1, 0, 0}, 0, 1, 0.5}, {{0, 1, 0}, 0, 0.5, 0}});
  expect_rows(FisheyeEquisolid{}, {{{-1, 0, 0}, 0, 1, 0.5}, {{0, 1, 0}, 0, 0.5, 0}});
  expect_rows(FisheyeStereographic{}, {{{-1, 0, 0}, 0, 1, 0.5}, {{0, 1, 0}, 0, 0.5, 0}});
  expect_rows(FisheyeOrthographic{}, {{{-1, 0, 1}, 0, 0.5 + 0.5 * kHalfRoot, 0.5}, {{0, 0, 1}, 0, 0.5, 0.5}});
  expect_rows(DualParaboloid{}, {{{0, 0, 1}, 0, 0.5, 0.5},
                                 {{-1, 0, 0}, 0, 1, 0.5},
                                 {{0, 1, 0}, 0, 0.5, 0},
                                 {{0, 0, -1}, 1, 0.5, 0.5},
                                 {{1, 0, -1}, 1, 0.5 + 0.5 * std::tan(kPi / 8), 0.5}});
}

TEST(Axes, BallPicturesHavePlusXRight) {
  const double quarter = 0.5 * kHalfRoot;
  expect_rows(
      SphereMap{},
      {{{0, 0, 1}, 0, 0.5, 0.5}, {{1, 0, 0}, 0, 0.5 + quarter, 0.5}, {{0, 1, 0}, 0, 0.5, 0.5 - quarter}});
  expect_rows(MirrorBall{}, {{{0, 0, 1}, 0, 0.5, 0.5}, {{1, 0, 0}, 0, 0.5 + quarter, 0.5}});
}

TEST(Axes, OctahedraFollowTheirPapers) {
  const std::vector<Row> square = {{{0, 1, 0}, 0, 0.5, 0.5},
                                   {{1, 0, 0}, 0, 1, 0.5},
                                   {{-1, 0, 0}, 0, 0, 0.5},
                                   {{0, 0, 1}, 0, 0.5, 1},
                                   {{0, 0, -1}, 0, 0.5, 0}};
  expect_rows(Octahedral{}, square);
  expect_rows(OctahedralEqualArea{}, square);
  expect_rows(Octahedral{}, {{{1, -1, 1}, 0, 5.0 / 6, 5.0 / 6}, {{-1, 1, 1}, 0, 2.0 / 6, 4.0 / 6}});
  expect_rows(OctahedralRect{}, {{{0, 1, 0}, 0, 0.5, 0.5},
                                 {{1, 0, 0}, 0, 1, 1},
                                 {{-1, 0, 0}, 0, 0, 0},
                                 {{0, 0, 1}, 0, 0, 1},
                                 {{0, 0, -1}, 0, 1, 0},
                                 {{0, -1, 0}, 1, 0.5, 0.5},
                                 {{1, -1, 1}, 1, 0.5, 5.0 / 6}});
  expect_rows(HemiOctahedral{}, {{{0, 1, 0}, 0, 0.5, 0.5},
                                 {{1, 0, 0}, 0, 0, 1},
                                 {{-1, 0, 0}, 0, 1, 0},
                                 {{0, 0, 1}, 0, 1, 1},
                                 {{0, 0, -1}, 0, 0, 0}});
  expect_rows(OctahedralPerspective{}, {{{0, 1, 0}, 0, 0.5, 0},
                                        {{1, 0, 0}, 0, 0, 1},
                                        {{0, 0, 1}, 0, 1, 1},
                                        {{1, 1, 1}, 0, 0.5, 2.0 / 3},
                                        {{0, -1, 0}, 2, 0.5, 1},
                                        {{-1, -1, -1}, 7, 0.5, 1.0 / 3},
                                        {{-1, 0, 0}, 1, 1, 1}});
}

TEST(Axes, HalfCubeIsTheTopOfACross) {
  expect_rows(HalfCube{}, {{{0, 1, 0}, 0, 0.5, 0.5},
                           {{1, 0, 0}, 0, 0, 0.5},
                           {{-1, 0, 0}, 0, 1, 0.5},
                           {{0, 0, 1}, 0, 0.5, 1},
                           {{0, 0, -1}, 0, 0.5, 0},
                           {{1, 1, 0}, 0, 0.25, 0.5},
                           {{0, 0.5, 1}, 0, 0.5, 0.875}});
}

TEST(Axes, HealpixFollowsGorskiTurnedToPlusYUp) {
  // Colatitude and longitude of base pixels 0, 4, 8, and of pixels 0 and 1 of the nested scheme with Nside
  // = 2.
  const auto direction = [](double z, double longitude) {
    const double side = std::sqrt(1 - z * z);
    return Vec3d{side * std::sin(longitude), z, side * std::cos(longitude)};
  };
  expect_rows(Healpix{}, {{direction(2.0 / 3, kPi / 4), 0, 0.5, 0.5},
                          {direction(0, 0), 4, 0.5, 0.5},
                          {direction(0, kPi / 2), 5, 0.5, 0.5},
                          {direction(-2.0 / 3, kPi / 4), 8, 0.5, 0.5},
                          {direction(1.0 / 3, kPi / 4), 0, 0.25, 0.75},
                          {direction(2.0 / 3, kPi * 3 / 8), 0, 0.25, 0.25}});
}

/// Largest over smallest density on a lattice that includes the middles and ends of the charts.
template <class P>
double density_ratio(const P& p) {
  double low = INFINITY, high = 0;
  for (int j = 0; j <= 64; ++j) {
    for (int i = 0; i <= 64; ++i) {
      const double u = i / 64.0, v = j / 64.0;
      if (!p.valid(0, u, v)) continue;
      low = std::min(low, p.solid_angle_density(0, u, v));
      high = std::max(high, p.solid_angle_density(0, u, v));
    }
  }
  return high / low;
}

TEST(SamplingRate, IsWhatTheSourcesSay) {
  EXPECT_NEAR(density_ratio(Cube{}), 3 * std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(density_ratio(EquiAngularCube{}), std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(density_ratio(DualParaboloid{}), 4, 1e-12);
  // The middle of a side, (1/3, 1/3), is not on the lattice.
  const Octahedral octahedral;
  EXPECT_NEAR(
      octahedral.solid_angle_density(0, 2.0 / 3, 2.0 / 3) / octahedral.solid_angle_density(0, 0.5, 0.5),
      3 * std::sqrt(3.0), 1e-12);
  for (const double ratio : {density_ratio(EqualArea{}), density_ratio(SphereMap{}), density_ratio(Healpix{}),
                             density_ratio(OctahedralEqualArea{}), density_ratio(FisheyeEquisolid{})}) {
    EXPECT_NEAR(ratio, 1, 1e-12);
  }
}

TEST(SamplingRate, PerspectiveAndPlanarOctahedronSampleASideAlike) {
  const Octahedral planar;
  const OctahedralPerspective perspective;
  for (const Vec3d& d : spread_directions(1000)) {
    const ChartPoint<double> a = planar.from_sphere(d), b = perspective.from_sphere(d);
    const double ratio = planar.solid_angle_density(0, a.u, a.v) /
                         perspective.solid_angle_density(static_cast<int>(b.chart), b.u, b.v);
    ASSERT_NEAR(ratio, 4, 1e-12);
  }
}

TEST(SphereMap, IsTheLookUpByHalfVector) {
  const SphereMap p;
  for (const Vec3d& d : spread_directions(1000)) {
    const Vec3d h = normalize(d + Vec3d{0, 0, 1});
    const ChartPoint<double> at = p.from_sphere(d);
    ASSERT_NEAR(at.u, 0.5 + 0.5 * h.x, 1e-12);
    ASSERT_NEAR(at.v, 0.5 - 0.5 * h.y, 1e-12);
  }
}

TEST(MirrorBall, FromInfinityIsTheSphereMap) {
  for (const Position& at : random_positions(MirrorBall::kCharts, 2000, -1, 2)) {
    ASSERT_LE(distance(MirrorBall{}.to_sphere(0, at.u, at.v), SphereMap{}.to_sphere(0, at.u, at.v)), 1e-12);
  }
  EXPECT_EQ(MirrorBall{}.blind_angle(), 0);
}

/// Traces the camera's ray to the ball, and reflects it.
TEST(MirrorBall, IsWhatACameraSeesInABall) {
  for (const double far : {1.01, 1.2, 2.0, 5.0, 100.0}) {
    const MirrorBall p(far);
    const double widest = 1 / std::sqrt(far * far - 1);
    for (const Position& at : random_positions(MirrorBall::kCharts, 2000, 0, 1)) {
      if (!p.valid(0, at.u, at.v)) continue;
      const Vec3d camera{0, 0, far};
      const Vec3d ray = normalize(Vec3d{widest * (2 * at.u - 1), widest * (1 - 2 * at.v), -1});
      const double middle = -dot(camera, ray);
      const double hit = middle - std::sqrt(std::max(middle * middle - (far * far - 1), 0.0));
      const Vec3d normal = camera + hit * ray;
      const Vec3d reflected = ray - 2 * dot(ray, normal) * normal;
      // 1e-6: the tracer's own square root at the outline.
      ASSERT_LE(distance(p.to_sphere(0, at.u, at.v), reflected), 1e-6) << far << " " << at.u << " " << at.v;
    }
  }
}

TEST(MirrorBall, ReportsTheBlindCone) {
  const MirrorBall p(2);
  EXPECT_NEAR(p.blind_angle(), kPi / 6, 1e-15);
  const auto at_angle = [](double from_back) { return Vec3d{std::sin(from_back), 0, -std::cos(from_back)}; };
  EXPECT_TRUE(p.covers(at_angle(kPi / 6 + 1e-9)));
  EXPECT_FALSE(p.covers(at_angle(kPi / 6 - 1e-9)));
  EXPECT_NEAR(p.coverage(), 2 * kPi * (1 + std::cos(kPi / 6)), 1e-12);
  EXPECT_NEAR(p.from_sphere(at_angle(kPi / 6)).u, 1, 1e-7);
}

TEST(MirrorBall, IsInvertedAtEveryDistance) {
  for (const double far : {1.01, 1.05, 1.2, 1.5, 3.0, 10.0, 1e3, 1e6}) {
    const MirrorBall p(far);
    for (const Vec3d& d : spread_directions(2000)) {
      if (!p.covers(d)) continue;
      const ChartPoint<double> at = p.from_sphere(d);
      ASSERT_LE(distance(p.to_sphere(0, at.u, at.v), d), 1e-13 + wobble(p, 0, at.u, at.v, 1e-15)) << far;
    }
  }
}

TEST(Aspect, MakesTexelsSquareWhereStated) {
  EXPECT_EQ(LatLong{}.aspect(), 2);
  EXPECT_NEAR(Mercator{}.aspect(), 1, 1e-12);
  // Along the equator of a panorama, and in the middle of the other charts: |d_u| / |d_v| is the aspect.
  const auto check = [](const auto& p, const Position& at) {
    const Tangents t = tangents(p, at, 1e-5);
    EXPECT_NEAR(length(t.along_u) / length(t.along_v), p.aspect(), 1e-6) << p.kName;
  };
  check(LatLong{}, {0, 0.3, 0.5});
  check(EqualArea{}, {0, 0.3, 0.5});
  check(SkyLatLong{}, {0, 0.3, 1});
  check(Cylinder{}, {0, 0.3, 0.5});
  check(Cylinder(150), {0, 0.3, 0.5});
  check(Mercator(60), {0, 0.3, 0.5});
  check(OctahedralPerspective{}, {3, 0.5, 1.0 / 3});
  check(HalfCube{}, {0, 0.5, 0.5});
  check(Vr180{}, {0, 0.2, 0.5});
  check(Window<90, 270, 60, -20>{}, {0, 0.3, 0.75});
}

TEST(Parameters, AreVisitedAndTakeEffect) {
  FisheyeEquidistant fisheye;
  int visits = 0;
  visit_parameters(fisheye, [&](const char* name, double& value, double low, double high, const char*) {
    EXPECT_STREQ(name, "fov");
    EXPECT_EQ(value, 180);
    EXPECT_LE(low, value);
    EXPECT_EQ(high, 360);
    value = 220;
    ++visits;
  });
  EXPECT_EQ(visits, 1);
  const FisheyeEquidistant wide(220);
  EXPECT_EQ(fisheye.coverage(), wide.coverage());
  EXPECT_EQ(fisheye.to_sphere(0, 0.1, 0.3).x, wide.to_sphere(0, 0.1, 0.3).x);

  const MirrorBall ball(4);
  visit_parameters(ball, [&](const char* name, const double& value, double, double, const char*) {
    EXPECT_STREQ(name, "distance");
    EXPECT_EQ(value, 4);
    ++visits;
  });
  const Cube cube;
  visit_parameters(cube, [&](const char*, const double&, double, double, const char*) { ++visits; });
  EXPECT_EQ(visits, 2);
}

}  // namespace
}  // namespace welkin::sphere
