#include "welkin/map/pyramid.h"

#include "welkin/map/map_cases.h"

namespace welkin {
namespace {

using namespace cases;

class PyramidTest : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(All, PyramidTest, ::testing::ValuesIn(names_and_windows()), test_name);

/// A map of a level, to look at.
Map map_of(const Map& like, const Level& level) {
  Map map(like.parameterization, level.width(), level.height(), level.channels());
  for (int chart = 0; chart < level.charts(); ++chart)
    copy_pixels(level.chart(chart), map.level.chart(chart));
  return map;
}

TEST(PyramidTest, LevelsBelow) {
  EXPECT_EQ(levels_below(1, 1), 0);
  EXPECT_EQ(levels_below(2, 1), 1);
  EXPECT_EQ(levels_below(3, 3), 2);
  EXPECT_EQ(levels_below(256, 128), 8);
  EXPECT_EQ(levels_below(257, 128), 9);
}

TEST_P(PyramidTest, ConstantsStayAndSizesHalveRoundedUp) {
  const Map map = rendered(
      GetParam(), 27, [](const Vec3d&) { return 0.75; }, 3);
  const std::vector<Level> pyramid = make_pyramid(map, 99);
  ASSERT_EQ(static_cast<int>(pyramid.size()), levels_below(map.width(), map.height()));
  int width = map.width(), height = map.height();
  for (const Level& level : pyramid) {
    width = (width + 1) / 2;
    height = (height + 1) / 2;
    ASSERT_EQ(level.width(), width);
    ASSERT_EQ(level.height(), height);
    const Map seen = map_of(map, level);
    for_each_valid_texel(seen, [&](int chart, int x, int y) {
      for (int c = 0; c < 3; ++c) ASSERT_NEAR(level.chart(chart).at(x, y)[c], 0.75 * (c + 1), 3e-6);
    });
  }
}

std::vector<double> shares(int fine, int coarse, int index) {
  std::vector<double> list;
  const double step = static_cast<double>(fine) / coarse;
  for (int i = 0; i < fine; ++i) {
    list.push_back(std::max(0.0, std::min((index + 1) * step, i + 1.0) - std::max(index * step, 1.0 * i)));
  }
  return list;
}

/// Σ over a level's texels of value × the solid angle of what it averages is the same sum over the finer
/// level: even sizes and odd ones, three-channel fast path and general one. Coarse texels whose centres lie
/// outside a disc are not valid, so what they would average (a ring of half a texel) is left out
/// of both.
TEST_P(PyramidTest, EveryLevelKeepsTheEnergyOfTheOneAbove) {
  for (const int size : {16, 17}) {
    for (const int channels : {3, 5}) {
      const Map map = rendered(GetParam(), size, waves(40, 30), channels);
      const Map coarser = map_of(map, reduce(map.parameterization, map.level));
      std::vector<float> row(static_cast<std::size_t>(map.width()));
      double fine = 0, coarse = 0, total = 0;
      for (int chart = 0; chart < map.charts(); ++chart) {
        std::vector<std::vector<float>> weights;
        for (int y = 0; y < map.height(); ++y) {
          texel_solid_angles(map.parameterization, map.width(), map.height(), chart, y, row.data());
          weights.push_back(row);
        }
        for (int j = 0; j < coarser.height(); ++j) {
          const auto down = shares(map.height(), coarser.height(), j);
          for (int i = 0; i < coarser.width(); ++i) {
            if (!is_valid_texel(coarser, chart, i, j)) continue;
            const auto across = shares(map.width(), coarser.width(), i);
            double solid_angle = 0;
            for (int y = 0; y < map.height(); ++y) {
              for (int x = 0; x < map.width(); ++x) {
                const auto at_x = static_cast<std::size_t>(x), at_y = static_cast<std::size_t>(y);
                const double weight = down[at_y] * across[at_x] * static_cast<double>(weights[at_y][at_x]);
                solid_angle += weight;
                fine += weight * static_cast<double>(*map.level.chart(chart).at(x, y));
              }
            }
            total += solid_angle;
            coarse += solid_angle * static_cast<double>(*coarser.level.chart(chart).at(i, j));
          }
        }
      }
      EXPECT_GT(total, 0.7 * map.parameterization.coverage());
      EXPECT_NEAR(coarse / total, fine / total, 1e-6) << size << " " << channels;
    }
  }
}

/// A lat-long's rows weigh sin θ, exactly in proportion to what they cover: so the mean over the sphere is
/// kept down to one texel, and the plain 2×2 average does not keep it.
TEST(PyramidTest, SolidAngleWeightsKeepTheMeanOverTheSphereAndEqualOnesDoNot) {
  for (const int height : {32, 21}) {
    Map map(sphere::AnyParameterization::make("latlong"), 2 * height, height, 1);
    render(map, [](const Vec3d& d) { return d.y > 0.9 ? 10.0 : 1.0; });
    const double expected = mean_over_sphere(map);
    // Of an odd height, rows overlap and are no longer in proportion.
    const double tolerance = height == 32 ? 1e-5 : 0.05;
    for (const Level& level : make_pyramid(map, 99)) {
      EXPECT_NEAR(mean_over_sphere(map_of(map, level)), expected, tolerance) << level.width();
    }
    const Map last = map_of(map, make_pyramid(map, 99, TexelWeight::equal).back());
    EXPECT_GT(std::fabs(mean_over_sphere(last) - expected), 0.5);
  }
}

TEST(PyramidTest, BordersOfEveryLevelAreFilled) {
  const Map map = rendered("cube", 32, smooth);
  for (const Level& level : make_pyramid(map, 3)) {
    Map again = map_of(map, level);
    fill_borders(again);
    for (int y = -kBorder; y < level.height() + kBorder; ++y) {
      for (int x = -kBorder; x < level.width() + kBorder; ++x) {
        ASSERT_EQ(*level.chart(2).at(x, y), *again.level.chart(2).at(x, y));
      }
    }
  }
}

}  // namespace
}  // namespace welkin
