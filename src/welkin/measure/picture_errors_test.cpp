#include "welkin/measure/picture_errors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "welkin/base/error.h"
#include "welkin/image/color_ramp.h"

namespace welkin {
namespace {

/// R G B A: radiance that grows to the right and down; the left column isn't covered.
Image slope(float scale) {
  Image picture(8, 4, 4);
  for (int y = 0; y < 4; ++y) {
    for (int x = 1; x < 8; ++x) {
      for (int c = 0; c < 3; ++c) picture.at(x, y)[c] = scale * static_cast<float>(1 + x + 8 * y + c);
      picture.at(x, y)[3] = 1;
    }
  }
  return picture;
}

TEST(PictureErrors, SeeWhatIsTooBright) {
  const Image truth = slope(1), bright = slope(1.25f);
  const PictureErrors errors = picture_errors({bright.view(), truth.view()});
  EXPECT_NEAR(errors.relative_rmse, 0.25, 1e-7);
  EXPECT_NEAR(errors.mean_error, 0.25, 1e-7);
  EXPECT_NEAR(errors.maximum, 0.25 * 34, 1e-5);
  EXPECT_EQ(errors.maximum_x, 7);
  EXPECT_EQ(errors.maximum_y, 3);
  EXPECT_EQ(errors.pixels, 28u);
  EXPECT_EQ(errors.truth_noise, 0);
}

TEST(PictureErrors, AreNoneBetweenEqualPictures) {
  const Image truth = slope(1);
  const PictureErrors errors = picture_errors({truth.view(), truth.view()});
  EXPECT_EQ(errors.relative_rmse, 0);
  EXPECT_EQ(errors.maximum, 0);
  const Image black(8, 4, 4);
  EXPECT_EQ(picture_errors({black.view(), black.view()}).pixels, 0u);
  EXPECT_EQ(picture_errors({black.view(), black.view()}).relative_rmse, 0);
}

TEST(PictureErrors, TellTheTruthsNoise) {
  const Image truth = slope(2), error = slope(0.02f), other = slope(2.2f);
  const PictureErrors errors = picture_errors({other.view(), truth.view(), error.view()});
  EXPECT_NEAR(errors.truth_noise, 0.01, 1e-7);
  EXPECT_NEAR(errors.relative_rmse, 0.1, 1e-6);
}

TEST(PictureErrors, SkipWhatIsNotFinite) {
  Image truth = slope(1);
  const Image other = slope(1);
  truth.at(3, 2)[1] = std::numeric_limits<float>::quiet_NaN();
  const PictureErrors errors = picture_errors({other.view(), truth.view()});
  EXPECT_EQ(errors.skipped, 1u);
  EXPECT_EQ(errors.pixels, 27u);
  EXPECT_EQ(errors.relative_rmse, 0);
}

TEST(PictureErrors, RefuseWhatDoesNotFit) {
  const Image truth = slope(1), small(7, 4, 4), two(8, 4, 2);
  EXPECT_THROW(picture_errors({small.view(), truth.view()}), Error);
  EXPECT_THROW(picture_errors({two.view(), two.view()}), Error);
  EXPECT_THROW(side_by_side({truth.view(), small.view()}), Error);
}

// The difference's colours are those of the errors' logarithm: 1 is the bright end, 1e-3 the dark one.
TEST(SideBySide, ShowsBothAndTheirDifference) {
  const Image truth = slope(1), twice = slope(2), near = slope(1.001f);
  const Image far = side_by_side({twice.view(), truth.view()});
  ASSERT_EQ(far.width(), 3 * 8 + 2 * 2);
  EXPECT_EQ(far.at(5, 2)[0], twice.at(5, 2)[0]);
  EXPECT_EQ(far.at(10 + 5, 2)[2], truth.at(5, 2)[2]);
  EXPECT_EQ(far.at(8, 1)[0], 1);
  const auto is = [](const float* pixel, const std::array<float, 3>& colour) {
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(pixel[c], colour[c], 2e-3);
  };
  is(far.at(20 + 7, 3), color_ramp(1));
  is(far.at(20, 0), neutral_color());
  is(side_by_side({near.view(), truth.view()}).at(20 + 7, 3), color_ramp(0));
}

}  // namespace
}  // namespace welkin
