#include "welkin/lighting_set/stored_error.h"

#include <gtest/gtest.h>

#include <cmath>

#include "welkin/base/error.h"

namespace welkin {
namespace {

Map filled(float value, int width = 4) {
  Map map(sphere::AnyParameterization::make("cube"), width, width, 3);
  for (int chart = 0; chart < 6; ++chart) {
    for (int y = 0; y < width; ++y) std::fill_n(map.level.chart(chart).row(y), 3 * width, value);
  }
  return map;
}

TEST(StoredError, IsThatOfEvenMaps) {
  const StoredError error = stored_error(filled(2), filled(2.5f));
  EXPECT_EQ(error.values, 6u * 4 * 4 * 3);
  EXPECT_DOUBLE_EQ(error.relative_rmse(), 0.25);
  EXPECT_NEAR(error.rmsle(), std::log(3.5 / 3), 1e-15);
}

TEST(StoredError, OfEqualMapsIsNone) {
  EXPECT_EQ(stored_error(filled(0), filled(0)).relative_rmse(), 0);
  EXPECT_EQ(stored_error(filled(3), filled(3)).rmsle(), 0);
}

TEST(StoredError, AddsUpByValues) {
  StoredError both = stored_error(filled(1), filled(1.5f));
  both += stored_error(filled(1, 8), filled(1, 8));
  // One value of five is off by ½.
  EXPECT_NEAR(both.relative_rmse(), std::sqrt(0.25 / 5), 1e-15);
}

TEST(StoredError, NegativeValuesCountAsNothingInLogarithms) {
  EXPECT_EQ(stored_error(filled(-1), filled(0)).rmsle(), 0);
}

TEST(StoredError, RefusesOtherSizes) {
  EXPECT_THROW(stored_error(filled(1), filled(1, 8)), Error);
}

}  // namespace
}  // namespace welkin
