#include "welkin/plot/draw_fresnel.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "welkin/base/error.h"
#include "welkin/image/color_ramp.h"
#include "welkin/math/scalar.h"

namespace welkin {
namespace {

/// The row in which column x of the picture is nearest to the colour.
int row_of(const Image& picture, int x, const std::array<float, 3>& color) {
  int best = -1;
  float least = 1e9f;
  for (int y = 0; y < picture.height(); ++y) {
    float difference = 0;
    for (std::size_t c = 0; c < 3; ++c) difference += std::fabs(picture.at(x, y)[c] - color[c]);
    if (difference < least) {
      least = difference;
      best = y;
    }
  }
  return best;
}

TEST(DrawFresnel, TheCurvesLieWhereTheReflectancesAre) {
  // At a width of 720 the axes span x = 80 … 640 and y = 32 … 392.
  const brdf::Boundary glass{1.5, 0}, dense{5, 0};
  const Image picture = draw_fresnel(std::array{glass, dense}, 720);
  ASSERT_EQ(picture.width(), 720);
  for (const int degrees : {20, 40, 55, 70, 80}) {
    const int x = 80 + 560 * degrees / 90;
    const double cosine = std::cos(degrees * kPi / 180);
    EXPECT_NEAR(row_of(picture, x, color_ramp(0)), 392 - 360 * brdf::fresnel(cosine, glass), 3) << degrees;
    EXPECT_NEAR(row_of(picture, x, color_ramp(0.82)), 392 - 360 * brdf::fresnel(cosine, dense), 3) << degrees;
  }
}

TEST(DrawFresnel, RefusesWhatItCannotDraw) {
  EXPECT_THROW(draw_fresnel(std::array{brdf::Boundary{}}, 100), Error);
  EXPECT_THROW(draw_fresnel(std::array{brdf::Boundary{}}, 5000), Error);
  EXPECT_THROW(draw_fresnel(std::array{brdf::Boundary{0, 0}}), Error);
  EXPECT_EQ(draw_fresnel({}).width(), 720);
}

}  // namespace
}  // namespace welkin
