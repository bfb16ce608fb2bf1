#include "welkin/map_file/safety_border.h"

#include <gtest/gtest.h>

#include <random>

#include "welkin/base/error.h"
#include "welkin/map/borders.h"
#include "welkin/map/pyramid.h"

namespace welkin {
namespace {

Map random_map(const char* name, int size) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> value(0, 1);
  Map map(sphere::AnyParameterization::make(name), size, size, 1);
  for (int chart = 0; chart < map.charts(); ++chart) {
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) *map.level.chart(chart).at(x, y) = value(random);
    }
  }
  fill_borders(map);
  return map;
}

/// Plain 2×2 averages, as a renderer's mip chain has them.
Image halved(const Image& from) {
  Image to(from.width() / 2, from.height() / 2, 1);
  for (int y = 0; y < to.height(); ++y) {
    for (int x = 0; x < to.width(); ++x) {
      *to.at(x, y) = 0.25f * (*from.at(2 * x, 2 * y) + *from.at(2 * x + 1, 2 * y) +
                              *from.at(2 * x, 2 * y + 1) + *from.at(2 * x + 1, 2 * y + 1));
    }
  }
  return to;
}

/// Up to the coarsest level served, the innermost ring of the border holds exactly what lies past the edge at
/// that level: on an octahedron, whose border texels are texels, a level's own border.
TEST(SafetyBorder, ServesLevelsUpToTheCoarsestOne) {
  constexpr int kSize = 64, kWidth = 8;
  const Map map = random_map("octahedral", kSize);
  const int coarsest = coarsest_level_served(kWidth, kSize);
  ASSERT_EQ(coarsest, 3);
  const std::vector<Level> pyramid = make_pyramid(map, coarsest, TexelWeight::equal);
  Image picture = with_safety_border(map, 0, kWidth);
  for (int l = 1; l <= coarsest; ++l) {
    picture = halved(picture);
    const Level& level = pyramid[static_cast<std::size_t>(l - 1)];
    const int border = kWidth >> l, size = kSize >> l;
    for (int i = -1; i <= size; ++i) {
      for (const auto& [x, y] : {std::pair{i, -1}, {i, size}, {-1, i}, {size, i}}) {
        EXPECT_NEAR(*picture.at(x + border, y + border), *level.chart(0).at(x, y), 1e-6) << "level " << l;
      }
    }
  }
}

TEST(SafetyBorder, LevelServedNeedsWholeTexelsOfBorder) {
  EXPECT_EQ(coarsest_level_served(0, 64), -1);
  EXPECT_EQ(coarsest_level_served(1, 64), 0);
  EXPECT_EQ(coarsest_level_served(6, 64), 1);
  EXPECT_EQ(coarsest_level_served(8, 64), 3);
  EXPECT_EQ(coarsest_level_served(8, 36), 2);
}

/// A wide border continues as the narrow one begins, also where it is read along directions.
TEST(SafetyBorder, WideBordersOfCubesFollowTheSphere) {
  Map map(sphere::AnyParameterization::make("cube"), 32, 32, 1);
  for (int chart = 0; chart < 6; ++chart) {
    for (int y = 0; y < 32; ++y) {
      for (int x = 0; x < 32; ++x) {
        const Vec3d d = map.parameterization.to_sphere(chart, (x + 0.5) / 32, (y + 0.5) / 32);
        *map.level.chart(chart).at(x, y) = static_cast<float>(1 + 0.5 * d.x + 0.25 * d.y - 0.3 * d.z);
      }
    }
  }
  fill_borders(map);
  const Image wide = with_safety_border(map, 0, 16);
  for (int y = -16; y < 48; ++y) {
    for (int x = -16; x < 48; ++x) {
      const Vec3d d = map.parameterization.to_sphere(0, (x + 0.5) / 32, (y + 0.5) / 32);
      EXPECT_NEAR(*wide.at(x + 16, y + 16), 1 + 0.5 * d.x + 0.25 * d.y - 0.3 * d.z, 2e-4) << x << "," << y;
    }
  }
}

TEST(SafetyBorder, RefusesBordersWiderThanTheChart) {
  EXPECT_THROW(with_safety_border(random_map("octahedral", 8), 0, 9), Error);
}

}  // namespace
}  // namespace welkin
