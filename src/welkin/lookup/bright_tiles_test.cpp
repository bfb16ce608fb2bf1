#include "welkin/lookup/bright_tiles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

namespace welkin::test {
namespace {

/// Masses of radiance 1.
FaceGrid grid_of_ones(int size, int margin) {
  FaceGrid grid(size, margin, LargeMemory::Contents::zero);
  const double step = 2 * std::atan(1.0) / size;
  for (int face = 0; face < 6; ++face) {
    for (int y = 0; y < grid.side(); ++y) {
      for (int x = 0; x < grid.side(); ++x) {
        const double s = std::tan((x + 0.5 - 0.5 * grid.side()) * step);
        const double t = std::tan((y + 0.5 - 0.5 * grid.side()) * step);
        const double r2 = 1 + s * s + t * t;
        const double area = step * step * (1 + s * s) * (1 + t * t) / (r2 * std::sqrt(r2));
        std::fill_n(grid.at(face, x, y), FaceGrid::kValues, static_cast<float>(area));
      }
    }
  }
  return grid;
}

TEST(BrightTiles, TellTheRadianceOfMasses) {
  for (const int size : {64, 75}) {
    const BrightTiles tiles(grid_of_ones(size, 11), {1, 0.5f, 0});
    // Solid angles are those of the middles of tiles of eight texels.
    EXPECT_NEAR(tiles.most(0, size + 21, 0, size + 21), 1, 0.15);
  }
}

TEST(BrightTiles, FindALightInEveryMirrorImageAndNotElsewhere) {
  std::mt19937 random(3);
  for (const int size : {64, 75}) {
    const int side = size + 22;
    const auto any = [&](int end) { return static_cast<int>(random() % static_cast<unsigned>(end)); };
    for (int trial = 0; trial < 30; ++trial) {
      FaceGrid grid = grid_of_ones(size, 11);
      const int x = any(side), y = any(side);
      grid.at(any(6), x, y)[any(3)] *= -1000;
      const BrightTiles tiles(grid, {1, 1, 1});
      for (int image = 0; image < 8; ++image) {
        int at_x = image & 1 ? side - 1 - x : x, at_y = image & 2 ? side - 1 - y : y;
        if (image & 4) std::swap(at_x, at_y);
        const int left = any(20), right = any(20), up = any(20), down = any(20);
        EXPECT_GT(tiles.most(at_x - left, at_x + right, at_y - up, at_y + down), 850);
      }
      // By the distance from the nearer edges, a tile or more away from it.
      const int near = std::min({x, side - 1 - x, y, side - 1 - y});
      const int far = std::max(std::min(x, side - 1 - x), std::min(y, side - 1 - y));
      const int middle = (side - 1) / 2;
      if (near >= 16) {
        EXPECT_LT(tiles.most(0, 7, 0, side - 1), 2) << near;
      }
      if (far < middle - 9) {
        EXPECT_LT(tiles.most(middle - 1, middle + 1, middle - 1, middle + 1), 2) << far;
      }
    }
  }
}

}  // namespace
}  // namespace welkin::test
