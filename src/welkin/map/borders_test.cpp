#include "welkin/map/borders.h"

#include <limits>

#include "welkin/map/map_cases.h"
#include "welkin/map/texel_points.h"

namespace welkin {
namespace {

using namespace cases;

class BordersTest : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(All, BordersTest, ::testing::ValuesIn(names_and_windows()), test_name);

template <class Body>
void for_each_border_texel(const Map& map, int width, const Body& body) {
  for (int chart = 0; chart < map.charts(); ++chart) {
    for (int y = -width; y < map.height() + width; ++y) {
      for (int x = -width; x < map.width() + width; ++x) {
        const bool inside = x >= 0 && x < map.width() && y >= 0 && y < map.height();
        if (!inside || !is_valid_texel(map, chart, x, y)) body(chart, x, y);
      }
    }
  }
}

/// Past their edges these continue in texels of another edge, or of another part of the same one.
TEST(BordersTest, ExactTopologiesRepeatTexelsBitForBit) {
  for (const char* name : {"latlong", "octahedral", "octahedral-rect", "octahedral-equal-area"}) {
    // Even around, so that the texel across a pole is one.
    Map map(sphere::AnyParameterization::make(name), 32, 16, 2);
    if (name[0] == 'o') map = Map(map.parameterization, 17, 17, 2);
    // Every texel has a value of its own.
    float next = 1;
    for_each_valid_texel(map, [&](int chart, int x, int y) {
      map.level.chart(chart).at(x, y)[0] = next++;
      map.level.chart(chart).at(x, y)[1] = -next;
    });
    fill_borders(map);
    for_each_border_texel(map, kBorder, [&](int chart, int x, int y) {
      const double u = (x + 0.5) / map.width(), v = (y + 0.5) / map.height();
      const auto position = map.parameterization.from_sphere(map.parameterization.to_sphere(chart, u, v));
      const int i = static_cast<int>(std::floor(position.u * map.width()));
      const int j = static_cast<int>(std::floor(position.v * map.height()));
      for (int c = 0; c < 2; ++c) {
        ASSERT_EQ(map.level.chart(chart).at(x, y)[c],
                  map.level.chart(static_cast<int>(position.chart)).at(i, j)[c])
            << name << " " << x << "," << y << " is " << i << "," << j;
      }
    });
  }
}

/// The border of a lat-long and of an octahedron, written out: wraps, and edges that turn round about their
/// middle.
TEST(BordersTest, KnownNeighbours) {
  Map map(sphere::AnyParameterization::make("latlong"), 8, 4, 1);
  float next = 0;
  for_each_valid_texel(map, [&](int chart, int x, int y) { *map.level.chart(chart).at(x, y) = next++; });
  fill_borders(map);
  const ImageView<const float> latlong = std::as_const(map.level).chart(0);
  EXPECT_EQ(*latlong.at(-1, 2), *latlong.at(7, 2));
  EXPECT_EQ(*latlong.at(8, 0), *latlong.at(0, 0));
  EXPECT_EQ(*latlong.at(1, -1), *latlong.at(5, 0));
  EXPECT_EQ(*latlong.at(6, 4), *latlong.at(2, 3));
  Map folded(sphere::AnyParameterization::make("octahedral"), 8, 8, 1);
  for_each_valid_texel(folded,
                       [&](int chart, int x, int y) { *folded.level.chart(chart).at(x, y) = next++; });
  fill_borders(folded);
  const ImageView<const float> octahedral = std::as_const(folded.level).chart(0);
  for (int i = 0; i < 8; ++i) {
    EXPECT_EQ(*octahedral.at(i, -1), *octahedral.at(7 - i, 0));
    EXPECT_EQ(*octahedral.at(-2, i), *octahedral.at(1, 7 - i));
  }
  EXPECT_EQ(*octahedral.at(-1, -1), *octahedral.at(7, 7));
}

/// A window wraps where it is all the way round, and goes on past a pole where it reaches one as well.
TEST(BordersTest, WindowsWrapAndPassPolesOnlyWhereTheyShowBoth) {
  const auto numbered = [](const char* spec) {
    Map map(sphere::AnyParameterization::make(spec), 8, 4, 1);
    float next = 0;
    for_each_valid_texel(map, [&](int chart, int x, int y) { *map.level.chart(chart).at(x, y) = next++; });
    fill_borders(map);
    return map;
  };
  const auto at = [](const Map& map, int x, int y) { return *std::as_const(map.level).chart(0).at(x, y); };
  for (const char* spec : {"latlong,top=30,bottom=-60", "latlong,left=0,right=360,bottom=0"}) {
    const Map map = numbered(spec);
    for (int y = 0; y < 4; ++y) {
      EXPECT_EQ(at(map, -1, y), at(map, 7, y)) << spec;
      EXPECT_EQ(at(map, 8, y), at(map, 0, y)) << spec;
    }
  }
  const Map pole = numbered("latlong,left=0,right=360,bottom=0");
  EXPECT_EQ(at(pole, 1, -1), at(pole, 5, 0));
  EXPECT_EQ(at(pole, 6, -2), at(pole, 2, 1));
  // Below the horizon there is nothing: the mean of three neighbours.
  EXPECT_NEAR(at(pole, 5, 4), at(pole, 5, 3), 1e-5);
  // A half has neither a seam nor another side of its poles.
  const Map half = numbered("latlong,left=-90,right=90");
  EXPECT_NEAR(at(half, -1, 2), at(half, 0, 2), 1e-5);
  EXPECT_NEAR(at(half, 3, -1), at(half, 3, 0), 1e-5);
  // 270° of longitude: past the pole of one half lies the other.
  const Map most = numbered("latlong,left=-180,right=90");
  // From −163.1° to 16.9°, which is 5⅓ columns of 33.75° on.
  EXPECT_NEAR(at(most, 0, -1), 16.0 / 3, 1e-4);
}

TEST_P(BordersTest, ConstantsReachAsFarAsKernelsDo) {
  for (const int size : {1, 2, 7, 64}) {
    const Map map = rendered(
        GetParam(), size, [](const Vec3d&) { return 0.375; }, 3);
    for_each_valid_texel(map, [&](int chart, int x, int y) {
      for (int j = -kBorder; j <= kBorder; ++j) {
        for (int i = -kBorder; i <= kBorder; ++i) {
          const int column = std::clamp(x + i, -kBorder, map.width() + kBorder - 1);
          const int row = std::clamp(y + j, -kBorder, map.height() + kBorder - 1);
          for (int c = 0; c < 3; ++c) {
            ASSERT_NEAR(map.level.chart(chart).at(column, row)[c], 0.375 * (c + 1), 1e-6)
                << size << ": " << chart << " " << column << "," << row;
          }
        }
      }
    });
  }
}

/// The largest error in the ring of two texels that bicubic interpolation reads.
double worst_error(const std::string& name, int size) {
  const Map map = rendered(name, size, smooth);
  double worst = 0;
  for_each_border_texel(map, 2, [&](int chart, int x, int y) {
    const double u = (x + 0.5) / map.width(), v = (y + 0.5) / map.height();
    const double expected = smooth(map.parameterization.to_sphere(chart, u, v));
    worst = std::max(worst, std::fabs(static_cast<double>(*map.level.chart(chart).at(x, y)) - expected));
  });
  return worst;
}

/// Inside a face Catmull–Rom's error is of the third order in the texel's size. Beside a corner three borders
/// interpolate from one another, and the worst texels are of the second.
TEST(BordersTest, CubesAreInterpolatedToTheSecondOrderAtLeast) {
  for (const char* name : {"cube", "eac"}) {
    for (const int size : {16, 32, 64, 128}) {
      EXPECT_LT(worst_error(name, size), 0.05 / (size * size) + 1e-6) << name << " " << size;
    }
  }
}

TEST(BordersTest, NothingPastTheRimIsTheMeanOfWhatIsBesideIt) {
  Map map(sphere::AnyParameterization::make("sky-latlong"), 16, 4, 1);
  for_each_valid_texel(
      map, [&](int chart, int x, int y) { *map.level.chart(chart).at(x, y) = static_cast<float>(x); });
  fill_borders(map);
  // Below the horizon: three neighbours above.
  EXPECT_NEAR(*map.level.chart(0).at(5, 4), 5, 1e-6);
  EXPECT_NEAR(*map.level.chart(0).at(0, 4), (0 + 1 + 15) / 3.0, 1e-6);
}

TEST(BordersTest, BordersOfOneMapDependOnNoOldOnes) {
  for (const char* name : {"cube", "half-cube", "fisheye-equidistant", "paraboloid"}) {
    Map clean = rendered(name, 40, smooth), stale = rendered(name, 40, smooth);
    for_each_border_texel(stale, kBorder,
                          [&](int chart, int x, int y) { *stale.level.chart(chart).at(x, y) = 1e9f; });
    fill_borders(stale);
    for_each_border_texel(clean, kBorder, [&](int chart, int x, int y) {
      const float value = *stale.level.chart(chart).at(x, y);
      // Deep in a disc's corners nothing is ever read, and nothing is written.
      if (value == 1e9f) {
        ASSERT_TRUE(x >= 0 && y >= 0 && x < 40 && y < 40) << name << " " << x << "," << y;
      } else {
        ASSERT_EQ(value, *clean.level.chart(chart).at(x, y)) << name << " " << x << "," << y;
      }
    });
  }
}

/// Texels that a rim cuts, and whose centre lies outside of it, hold what they are said to hold.
TEST(BordersTest, RimTexelsAreKeptOrMade) {
  const auto p = sphere::AnyParameterization::make("paraboloid");
  const auto make = [&](float rim, RimTexels how) {
    Map map(p, 33, 33, 1);
    for (int chart = 0; chart < 2; ++chart) {
      for (int y = 0; y < 33; ++y) {
        for (int x = 0; x < 33; ++x) {
          const bool valid = is_valid_texel(map, chart, x, y);
          *map.level.chart(chart).at(x, y) = valid ? 4 : is_outside_texel(p, {33, 33}, chart, x, y) ? 9 : rim;
        }
      }
    }
    fill_borders(map, how);
    std::vector<float> values;
    for (int chart = 0; chart < 2; ++chart) {
      for (int y = 0; y < 33; ++y) {
        for (int x = 0; x < 33; ++x) {
          if (!is_valid_texel(map, chart, x, y) && !is_outside_texel(p, {33, 33}, chart, x, y))
            values.push_back(*map.level.chart(chart).at(x, y));
        }
      }
    }
    return values;
  };
  const auto expect = [&](float rim, RimTexels how, float wanted) {
    const std::vector<float> values = make(rim, how);
    EXPECT_GT(values.size(), 40u);
    for (const float value : values) EXPECT_FLOAT_EQ(value, wanted) << rim;
  };
  expect(3, RimTexels::kept, 3);
  expect(0, RimTexels::kept, 0);
  expect(3, RimTexels::made, 4);
  // As from a file: light of their own, or a share of black.
  expect(3.5, RimTexels::measured, 3.5);
  expect(1, RimTexels::measured, 4);
  expect(8, RimTexels::measured, 4);
  expect(0, RimTexels::measured, 4);
  expect(std::numeric_limits<float>::quiet_NaN(), RimTexels::measured, 4);
}

}  // namespace
}  // namespace welkin
