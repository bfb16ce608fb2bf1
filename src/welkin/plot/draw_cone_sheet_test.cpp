#include "welkin/plot/draw_cone_sheet.h"

#include <gtest/gtest.h>

#include <cmath>

#include "welkin/base/error.h"
#include "welkin/map/map_cases.h"

namespace welkin::test {
namespace {

TEST(ConeSheet, HasATileForEachFilterNearThatOfRays) {
  const Map map = cases::rendered(
      "octahedral", 64, [](const Vec3d& d) { return 0.5 + 0.2 * d.x + 0.2 * d.y; }, 3);
  const Image sheet = draw_cone_sheet(map, {.filters = {ConeFilter::ewa, ConeFilter::probes}, .size = 48});
  ASSERT_EQ(sheet.width(), 3 * (48 + 6) + 6);
  // The middle of the ball.
  for (int tile = 1; tile < 3; ++tile) {
    for (int y = 20; y < 34; ++y) {
      for (int x = 20; x < 34; ++x) {
        for (int c = 0; c < 3; ++c) {
          EXPECT_NEAR(static_cast<double>(sheet.at(6 + tile * 54 + x, 6 + y)[c]),
                      static_cast<double>(sheet.at(6 + x, 6 + y)[c]), 0.02);
        }
      }
    }
  }
  EXPECT_EQ(sheet.at(6, 6)[0], 0) << "outside the ball";
}

TEST(ConeSheet, RefusesWhatItCantDraw) {
  const Map map = cases::rendered("cube", 8, cases::smooth);
  EXPECT_THROW(draw_cone_sheet(map, {.camera = "cube"}), Error);
  EXPECT_THROW(draw_cone_sheet(map, {.camera = "bal"}), Error);
  EXPECT_THROW(draw_cone_sheet(map, {.size = 3}), Error);
  EXPECT_THROW(draw_cone_sheet(map, {.exposure = std::nan("")}), Error);
  EXPECT_THROW(draw_cone_sheet(map, {.filters = {ConeFilter::mirrored}}), Error);
}

}  // namespace
}  // namespace welkin::test
