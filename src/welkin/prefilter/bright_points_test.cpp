#include "welkin/prefilter/bright_points.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "welkin/base/error.h"
#include "welkin/math/scalar.h"

namespace welkin::prefilter {
namespace {

constexpr int kWidth = 60, kHeight = 44, kChannels = 2;

/// The weight of a row and column.
float& at(PointGrid& grid, int x, int y, int c) {
  const int north = std::min(y, grid.height - 1 - y);
  return grid.at(north / 8, c)[x * 16 + north % 8 + (y == north ? 0 : 8)];
}

/// A dim noise and `lamps` lamps of random sizes 10² … 10⁴, some of them negative; the lanes past the equator
/// 0.
PointGrid noise(int lamps) {
  PointGrid grid(kWidth, kHeight, kChannels);
  std::fill_n(grid.lanes.data(), grid.lanes.size(), 0.0f);
  std::mt19937 random(1);
  std::uniform_real_distribution<float> value(0.1f, 0.2f), decades(2, 4);
  std::uniform_int_distribution<int> column(0, kWidth - 1), row(0, kHeight - 1);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      for (int c = 0; c < kChannels; ++c) at(grid, x, y, c) = value(random);
    }
  }
  for (int i = 0; i < lamps; ++i) {
    const int x = column(random), y = row(random);
    at(grid, x, y, i % 2) = (i % 5 == 0 ? -1.0f : 1.0f) * std::pow(10.0f, decades(random));
  }
  return grid;
}

double total(PointGrid& grid, int c) {
  double sum = 0;
  for (int i = 0; i < kWidth * kHeight; ++i) sum += static_cast<double>(at(grid, i % kWidth, i / kWidth, c));
  return sum;
}

double total(const BrightPoints& points, int c) {
  double sum = 0;
  for (int i = 0; i < points.count(); ++i)
    sum += static_cast<double>(points.weight[static_cast<std::size_t>(i * points.channels + c)]);
  return sum;
}

/// Nothing is lost but the rounding of floats.
TEST(BrightPoints, RemovedAndRemainingPointsAreAll) {
  for (const bool boxes : {false, true}) {
    for (const int lamps : {0, 1, 30, 200}) {
      PointGrid grid = noise(lamps);
      grid.boxes = boxes;
      const double before[] = {total(grid, 0), total(grid, 1)};
      const BrightPoints points = take_bright_points(grid, {}, {});
      EXPECT_EQ(points.count() > 0, lamps > 0);
      EXPECT_EQ(points.channels, kChannels);
      for (int c = 0; c < kChannels; ++c)
        EXPECT_NEAR((total(grid, c) + total(points, c)) / before[c], 1, 1e-6) << lamps;
    }
  }
}

/// Lamps are removed at their positions, the largest first, and nothing else changes.
TEST(BrightPoints, TheLargestAreRemovedFromTheGrid) {
  for (const int always : {1, 7, 50}) {
    PointGrid grid = noise(100), before = noise(100);
    BrightRule rule;
    rule.always = rule.maximum = always;
    const BrightPoints points = take_bright_points(grid, rule, {});
    ASSERT_EQ(points.count(), always);
    double minimum = 1e30, left = 0;
    for (int i = 0; i < points.count(); ++i) {
      const std::size_t k = static_cast<std::size_t>(i);
      const double theta = std::acos(static_cast<double>(points.y[k]));
      const double longitude = std::atan2(static_cast<double>(points.x[k]), static_cast<double>(points.z[k]));
      const double row = theta * kHeight / kPi - 0.5, column = (0.5 - longitude / (2 * kPi)) * kWidth - 0.5;
      EXPECT_NEAR(row, std::round(row), 1e-4);
      EXPECT_NEAR(column, std::round(column), 1e-4);
      double size = 0;
      for (int c = 0; c < kChannels; ++c) {
        const int x = static_cast<int>(std::lround(column)), y = static_cast<int>(std::lround(row));
        EXPECT_EQ(points.weight[k * kChannels + static_cast<std::size_t>(c)], at(before, x, y, c));
        EXPECT_EQ(at(grid, x, y, c), 0.0f);
        at(before, x, y, c) = 0;
        size = std::max(
            size, std::fabs(static_cast<double>(points.weight[k * kChannels + static_cast<std::size_t>(c)])));
      }
      minimum = std::min(minimum, size);
    }
    for (std::size_t i = 0; i < grid.lanes.size(); ++i) {
      EXPECT_EQ(grid.lanes.data()[i], before.lanes.data()[i]);
      left = std::max(left, std::fabs(static_cast<double>(grid.lanes.data()[i])));
    }
    EXPECT_GE(minimum, left);
  }
}

/// A box's three points have its centre, and its variance along the row: width²/12 (a Gauss rule is exact).
TEST(BrightPoints, BoxesHaveTheirWidth) {
  PointGrid grid = noise(0);
  grid.boxes = true;
  at(grid, 20, 21, 0) = 1e4f;
  const BrightPoints points = take_bright_points(grid, {}, {});
  double weight = 0, mean = 0, square = 0;
  for (int i = 0; i < points.count(); ++i) {
    const std::size_t k = static_cast<std::size_t>(i);
    const double share = static_cast<double>(points.weight[k * kChannels]);
    const double longitude = std::atan2(static_cast<double>(points.x[k]), static_cast<double>(points.z[k]));
    const double column = (0.5 - longitude / (2 * kPi)) * kWidth - 20.5;
    weight += share;
    mean += share * column;
    square += share * column * column;
  }
  EXPECT_NEAR(weight, 1e4, 1e-2);
  EXPECT_NEAR(mean / weight, 0, 1e-4);
  EXPECT_NEAR(square / weight, 1.0 / 12, 1e-4);
}

TEST(BrightPoints, NothingOfAnEvenOrBlackMapIsBright) {
  PointGrid grid = noise(0);
  EXPECT_EQ(take_bright_points(grid, {}, {}).count(), 0);
  std::fill_n(grid.lanes.data(), grid.lanes.size(), 0.0f);
  EXPECT_EQ(take_bright_points(grid, {}, {}).count(), 0);
}

/// Equal lamps too: the choice among them doesn't depend on the threads.
TEST(BrightPoints, TheSameWhateverTheThreads) {
  const auto chosen = [] {
    PointGrid grid = noise(0);
    for (int i = 0; i < 300; ++i) at(grid, i * 7 % kWidth, i * 3 % kHeight, i % 2) = 1000;
    const BrightPoints points = take_bright_points(grid, {}, {});
    std::vector<float> all = points.x;
    for (const std::vector<float>* each : {&points.y, &points.z, &points.weight})
      all.insert(all.end(), each->begin(), each->end());
    return all;
  };
  const std::vector<float> many = chosen();
  EXPECT_FALSE(many.empty());
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(many, chosen());
}

TEST(BrightPoints, AreCancelled) {
  PointGrid grid = noise(3);
  Monitor monitor;
  monitor.cancelled = [] { return true; };
  EXPECT_THROW(take_bright_points(grid, {}, monitor), Cancelled);
}

}  // namespace
}  // namespace welkin::prefilter
