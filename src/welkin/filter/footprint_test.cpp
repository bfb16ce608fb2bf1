#include "welkin/filter/footprint.h"

#include "welkin/map/map_cases.h"

namespace welkin {
namespace {

using namespace cases;

TEST(FootprintTest, LengthsAndTheNarrowSide) {
  const Footprint upright{{3, 0}, {0, 2}}, turned{{3 * 0.6, 3 * 0.8}, {-2 * 0.8, 2 * 0.6}},
      flat{{2, 2}, {1, 1}};
  EXPECT_NEAR(upright.narrow(), 2, 1e-12);
  EXPECT_NEAR(turned.narrow(), 2, 1e-12);
  EXPECT_NEAR(turned.right_length(), 3, 1e-12);
  EXPECT_NEAR(turned.down_length(), 2, 1e-12);
  EXPECT_NEAR(flat.narrow(), 0, 1e-6);
}

TEST(FootprintTest, ASelfConversionCrossesTheRatioOfTheSizes) {
  for (const char* name : {"latlong", "cube", "eac", "octahedral-equal-area", "healpix"}) {
    const Map source = make_map(name, 128);
    const Map target(source.parameterization, source.width() / 4, source.height() / 2, 1);
    for (int chart = 0; chart < target.charts(); ++chart) {
      const Footprint f =
          footprint_at(source, target, {}, chart, 0.31 * target.width(), 0.33 * target.height());
      EXPECT_NEAR(f.right_length(), 4, 0.05) << name;
      EXPECT_NEAR(f.down_length(), 2, 0.05) << name;
      EXPECT_NEAR(f.narrow(), 2, 0.05) << name;
    }
  }
}

/// Away from poles and folds the area of the footprint is the ratio of the two densities.
TEST(FootprintTest, ItsAreaIsTheRatioOfSolidAngles) {
  const Matrix3 turn = rotation_from_yaw_pitch_roll(33, 21, 7);
  for (const char* name : {"latlong", "cube", "mercator", "paraboloid"}) {
    const Map source = make_map("cube", 256), target = make_map(name, 64);
    for_each_valid_texel(target, [&](int chart, int x, int y) {
      if ((x + y) % 7 != 0) return;
      const double u = (x + 0.5) / target.width(), v = (y + 0.5) / target.height();
      const auto position =
          source.parameterization.from_sphere(turn * target.parameterization.to_sphere(chart, u, v));
      const double texel = source.parameterization.solid_angle_density(static_cast<int>(position.chart),
                                                                       position.u, position.v) /
                           source.width() / source.height();
      const double mine =
          target.parameterization.solid_angle_density(chart, u, v) / target.width() / target.height();
      const Footprint f = footprint_at(source, target, turn, chart, x + 0.5, y + 0.5);
      const double area = std::fabs(f.right[0] * f.down[1] - f.right[1] * f.down[0]);
      ASSERT_NEAR(area / (mine / texel), 1, 0.05) << name << " " << x << "," << y;
    });
  }
}

/// On an octahedron's edge texels fold back, at a pole their width vanishes: the footprint does neither.
TEST(FootprintTest, EdgesAndPolesOfTheSourceAreNotLost) {
  const Map target = make_map("cube", 16);
  for (const std::string& name : sphere::parameterization_names()) {
    const Map source = make_map(name, 256);
    for (int chart = 0; chart < 6; ++chart) {
      for (const double x : {0.0, 8.0, 16.0}) {
        for (const double y : {0.0, 8.0, 16.0}) {
          const Footprint f = footprint_at(source, target, {}, chart, x, y);
          ASSERT_TRUE(std::isfinite(f.right_length()) && std::isfinite(f.down_length())) << name;
          const Vec3d d = target.parameterization.to_sphere(chart, x / 16, y / 16);
          if (!source.parameterization.whole_world() || name == "sphere" || name == "mirror-ball" || d.y < 0)
            continue;
          ASSERT_GT(std::max(f.right_length(), f.down_length()), 2)
              << name << " " << chart << " " << x << "," << y;
        }
      }
    }
  }
}

/// As many texels of the source as the sizes say, but for a twentieth of the sphere at the poles of a
/// lat-long.
TEST(FootprintTest, TheNarrowSideLeavesPolesAside) {
  const Map cube = make_map("cube", 256), small_cube = make_map("cube", 16),
            latlong = make_map("latlong", 32);
  const double ratio = footprints_of(cube, small_cube, {}).narrow;
  EXPECT_NEAR(ratio, 16, 0.05);
  const double side = 256.0 * 2 / (kPi * latlong.height() / 2);
  EXPECT_GT(footprints_of(cube, latlong, {}).narrow, 0.25 * side);
  EXPECT_LT(footprints_of(cube, latlong, {}).narrow, side);
  EXPECT_TRUE(is_reconstructed(small_cube, cube, {}));
  EXPECT_FALSE(is_reconstructed(cube, small_cube, {}));
}

}  // namespace
}  // namespace welkin
