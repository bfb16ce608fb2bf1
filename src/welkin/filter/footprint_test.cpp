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

/// Every texel is in one tile, and where tiles are averaged they see nothing finer than their samples.
TEST(FootprintTest, TilesCoverABandOnce) {
  const Map source = make_map("latlong", 700), target = make_map("octahedral", 75);
  std::vector<int> seen(static_cast<std::size_t>(target.width() * target.height()));
  for (int y = 0; y < target.height(); y += kTileSide) {
    std::vector<FootprintTile> tiles;
    plan_tiles(source, target, {}, 0, y, std::min(kTileSide, target.height() - y), tiles);
    for (const FootprintTile& tile : tiles) {
      EXPECT_GE(tile.samples_right, 1);
      EXPECT_GE(tile.level, 0);
      EXPECT_LE(tile.level, 10);
      for (int j = tile.y; j < tile.y + tile.height; ++j) {
        for (int i = tile.x; i < tile.x + tile.width; ++i)
          ++seen[static_cast<std::size_t>(j * target.width() + i)];
      }
    }
  }
  EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), static_cast<std::ptrdiff_t>(seen.size()));
}

TEST(FootprintTest, TheLevelLeavesEightTexelsAcross) {
  const Map source = make_map("cube", 1024), target = make_map("cube", 16);
  std::vector<FootprintTile> tiles;
  plan_tiles(source, target, {}, 4, 0, 16, tiles);
  for (const FootprintTile& tile : tiles) {
    EXPECT_EQ(tile.level, 2);  // 1024/16 = 64 texels: 64/2³ = 8, less the footprint's rounding
    EXPECT_TRUE(tile.whole);
  }
  tiles.clear();
  plan_tiles(target, source, {}, 4, 0, 32, tiles);
  for (const FootprintTile& tile : tiles) EXPECT_EQ(tile.samples_right * tile.samples_down, 1);
}

TEST(FootprintTest, AveragedFractionRisesFromZeroToOne) {
  EXPECT_EQ(averaged_fraction(0), 0);
  EXPECT_EQ(averaged_fraction(1), 0);
  EXPECT_EQ(averaged_fraction(2.5f), 1);
  EXPECT_EQ(averaged_fraction(1000), 1);
  for (float t = 0; t < 3; t += 0.01f) EXPECT_GE(averaged_fraction(t + 0.01f), averaged_fraction(t));
}

}  // namespace
}  // namespace welkin
