#include "welkin/plot/draw_density.h"

#include <gtest/gtest.h>

#include <cmath>

#include "welkin/image/color_ramp.h"

namespace welkin {
namespace {

Image picture_of(const std::string& spec, int size) {
  const auto p = sphere::AnyParameterization::make(spec);
  return draw_density(p, density_of(p, size));
}

TEST(Density, ThePictureShowsTheScale) {
  const auto near = [](const float* pixel, const std::array<float, 3>& color, float tolerance) {
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(pixel[c], color[c], tolerance);
  };
  // Equal area: the average everywhere, and no contour lines out of rounding errors.
  const Image even = picture_of("octahedral-equal-area", 200);
  for (int y = 0; y < 200; ++y) {
    for (int x = 0; x < 200; ++x) near(even.at(x, y), color_ramp(0.5), 1e-3f);
  }
  // The discs: 2/(1 + r²)² of the average, so twice in the middle (which no contour passes), half at the rim;
  // grey outside.
  const Image discs = picture_of("paraboloid", 201);
  ASSERT_EQ(discs.width(), 2 * 201 + 2);
  near(discs.at(100, 100), color_ramp(0.75), 1e-3f);
  near(discs.at(10, 100), color_ramp((std::log2(2 / std::pow(1 + std::pow(90 / 100.5, 2), 2)) + 2) / 4),
       1e-3f);
  near(discs.at(2, 2), neutral_color(), 0);
  near(discs.at(201, 100), {1, 1, 1}, 0);
  // The average's contour is at r = √(√2 − 1).
  const int contour = static_cast<int>(100.5 + 100.5 * std::sqrt(std::sqrt(2.0) - 1));
  near(discs.at(contour, 100), {1, 1, 1}, 0.05f);
}

TEST(Density, ThePictureHasAScaleUnderIt) {
  const Image small = picture_of("cube", 4);
  EXPECT_GE(small.width(), 200);
  int black = 0, brightest = 0;
  for (int y = 4; y < small.height(); ++y) {
    for (int x = 0; x < small.width(); ++x) {
      const float* pixel = small.at(x, y);
      const auto yellow = color_ramp(1);
      black += pixel[0] + pixel[1] + pixel[2] < 0.01f ? 1 : 0;
      brightest += std::fabs(pixel[0] - yellow[0]) + std::fabs(pixel[2] - yellow[2]) < 0.05f ? 1 : 0;
    }
  }
  EXPECT_GT(black, 5 * 6);  // five ticks
  EXPECT_GT(brightest, 6);
}

}  // namespace
}  // namespace welkin
