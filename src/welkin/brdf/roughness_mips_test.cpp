#include "welkin/brdf/roughness_mips.h"

#include <gtest/gtest.h>

#include <cmath>

#include "welkin/base/error.h"

namespace welkin::brdf {
namespace {

/// A normal map of slopes by texel.
template <class Slopes>
Image normal_map(int width, int height, const Slopes& slopes) {
  Image image(width, height, 3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto [sx, sy] = slopes(x, y);
      const double size = std::sqrt(1 + sx * sx + sy * sy);
      image.at(x, y)[0] = static_cast<float>((sx / size + 1) / 2);
      image.at(x, y)[1] = static_cast<float>((sy / size + 1) / 2);
      image.at(x, y)[2] = static_cast<float>((1 / size + 1) / 2);
    }
  }
  return image;
}

Image one_texel(float value) {
  Image image(1, 1, 1);
  *image.at(0, 0) = value;
  return image;
}

struct Slope {
  double x, y;
};

// Whatever its tilt, a plane is as rough in every level.
TEST(RoughnessMips, PlanesKeepTheirRoughness) {
  for (const double tilt : {0.0, 0.5, 2.0}) {
    const Image normals = normal_map(12, 5, [&](int, int) { return Slope{tilt, -tilt / 2}; });
    for (const Image& level : roughness_mips(normals.view(), one_texel(0.4f).view()))
      for (int x = 0; x < level.width(); ++x) EXPECT_NEAR(*level.at(x, 0), 0.4, 1e-5) << tilt;
  }
}

// Slopes of ±s by turns have the variance s²: α² grows by it where two are one texel.
TEST(RoughnessMips, VarianceOfSlopesAddsToAlphaSquared) {
  const double s = 0.2, roughness = 0.3;
  const Image normals = normal_map(16, 16, [&](int x, int) { return Slope{x % 2 == 0 ? s : -s, 0}; });
  const auto levels = roughness_mips(normals.view(), one_texel(0.3f).view());
  ASSERT_EQ(levels.size(), 5u);
  EXPECT_NEAR(*levels[0].at(3, 3), roughness, 1e-6);
  for (std::size_t k = 1; k < 5; ++k)
    EXPECT_NEAR(std::pow(*levels[k].at(0, 0), 4), std::pow(roughness, 4) + s * s, 1e-6) << k;
}

// The last level's variance is that of all slopes, whatever the sides, odd ones too.
TEST(RoughnessMips, LastLevelHoldsTheVarianceOfTheWholeMap) {
  const auto slope = [](int x, int y) {
    return Slope{0.1 * std::sin(x * 1.7 + y), 0.15 * std::cos(y * 2.3 - x)};
  };
  for (const auto& [width, height] : {std::pair{16, 8}, std::pair{13, 7}, std::pair{1, 9}}) {
    double x_sum = 0, y_sum = 0, squares = 0;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const Slope at = slope(x, y);
        x_sum += at.x;
        y_sum += at.y;
        squares += at.x * at.x + at.y * at.y;
      }
    }
    const double count = width * height;
    const double variance = squares / count - (x_sum * x_sum + y_sum * y_sum) / (count * count);
    const auto levels = roughness_mips(normal_map(width, height, slope).view(), one_texel(0).view());
    EXPECT_NEAR(std::pow(*levels.back().at(0, 0), 4), variance, 1e-6);
  }
}

TEST(RoughnessMips, RoughnessIsAveragedAsAlphaSquared) {
  const Image normals = normal_map(2, 1, [](int, int) { return Slope{0, 0}; });
  Image roughness(2, 1, 1);
  *roughness.at(0, 0) = 0.2f;
  *roughness.at(1, 0) = 0.8f;
  const auto levels = roughness_mips(normals.view(), roughness.view());
  EXPECT_NEAR(std::pow(*levels[1].at(0, 0), 4), (std::pow(0.2, 4) + std::pow(0.8, 4)) / 2, 1e-6);
}

TEST(RoughnessMips, RefusesWhatItCannotUse) {
  const Image normals = normal_map(4, 4, [](int, int) { return Slope{0, 0}; });
  EXPECT_THROW(roughness_mips(normals.view(), Image(3, 4, 1).view()), Error);
  EXPECT_THROW(roughness_mips(Image(4, 4, 1).view(), one_texel(0.5f).view()), Error);
  EXPECT_THROW(roughness_mips(normals.view(), one_texel(1.5f).view()), Error);
  EXPECT_THROW(roughness_mips(normals.view(), one_texel(std::nanf("")).view()), Error);
  Image nothing(2, 2, 3);
  for (int i = 0; i < 4; ++i)
    for (int c = 0; c < 3; ++c) nothing.at(i % 2, i / 2)[c] = 0.5f;
  EXPECT_THROW(roughness_mips(nothing.view(), one_texel(0.5f).view()), Error);
}

}  // namespace
}  // namespace welkin::brdf
