#include "welkin/io/colour/colour_space.h"

#include <gtest/gtest.h>

#include <limits>

#include "welkin/base/error.h"
#include "welkin/io/colour/code_points.h"

namespace welkin::io {
namespace {

constexpr int kBt2020 = 9;

TEST(ColourSpace, Bt2020ToBt709IsTheMatrixOfBt2087) {
  const Matrix3 matrix = to_bt709(*chromaticities_of(kBt2020));
  // ITU-R BT.2407, annex 2 (the inverse of BT.2087's): four digits.
  const double expected[3][3] = {
      {1.6605, -0.5876, -0.0728}, {-0.1246, 1.1329, -0.0083}, {-0.0182, -0.1006, 1.1187}};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(matrix.rows[i][k], expected[i][k], 6e-5) << i << k;
  }
}

TEST(ColourSpace, AcesToBt709AdaptsTheWhite) {
  // ACES AP1 (S-2014-004), white about D60. The matrix of ACES's own transforms (Bradford), four digits.
  const Chromaticities ap1{{0.713, 0.293}, {0.165, 0.830}, {0.128, 0.044}, {0.32168, 0.33767}};
  const double expected[3][3] = {
      {1.7051, -0.6218, -0.0833}, {-0.1303, 1.1408, -0.0105}, {-0.0240, -0.1290, 1.1530}};
  const Matrix3 matrix = to_bt709(ap1);
  for (std::size_t i = 0; i < 3; ++i) {
    double white = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(matrix.rows[i][k], expected[i][k], 1e-4) << i << k;
      white += matrix.rows[i][k];
    }
    EXPECT_NEAR(white, 1, 1e-9);
  }
}

TEST(ColourSpace, Bt709IsItself) {
  EXPECT_TRUE(is_bt709(kBt709));
  EXPECT_FALSE(is_bt709(*chromaticities_of(kBt2020)));
}

TEST(ColourSpace, PrimariesThatMakeNoColoursAreErrors) {
  EXPECT_THROW(to_bt709({{0.6, 0.3}, {0.6, 0.3}, {0.1, 0.1}, {0.3, 0.3}}), Error);
  EXPECT_THROW(to_bt709({{0.64, 0.33}, {0.3, 0.6}, {0.15, 0.06}, {0.3, 0}}), Error);
  EXPECT_THROW(to_bt709({{}, {}, {}, {}}), Error);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, infinity, -infinity}) {
    for (int i = 0; i < 8; ++i) {
      Chromaticities c = kBt709;
      double* const numbers[] = {c.red, c.green, c.blue, c.white};
      numbers[i / 2][i % 2] = bad;
      EXPECT_THROW(to_bt709(c), Error) << bad << " at " << i;
    }
  }
  Chromaticities outside = kBt709;
  outside.white[0] = 0.7;
  EXPECT_THROW(to_bt709(outside), Error);
}

TEST(ColourSpace, XyzIsPrimariesToo) {
  // Code points 10, of which two have no luminance. Equal parts are white. The numbers were computed apart:
  // Bradford's adaptation from E to D65, then the inverse of BT.709's matrix.
  const Matrix3 matrix = to_bt709(*chromaticities_of(10));
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(matrix.rows[i][0] + matrix.rows[i][1] + matrix.rows[i][2], 1, 1e-9);
  const double expected[3][3] = {
      {3.1467, -1.6665, -0.4802}, {-0.9955, 1.9558, 0.0398}, {0.0636, -0.2146, 1.1510}};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(matrix.rows[i][k], expected[i][k], 1e-4) << i << k;
  }
}

TEST(ColourSpace, CurvesMeetTheirStandards) {
  EXPECT_NEAR(to_linear(Curve::pq, 1, 1) * kDiffuseWhite, 10000, 1e-6);
  EXPECT_NEAR(to_linear(Curve::pq, 1, 0.508078421517399) * kDiffuseWhite, 100, 1e-3);  // ST 2084
  EXPECT_EQ(to_linear(Curve::pq, 1, 0), 0);
  EXPECT_NEAR(to_linear(Curve::hlg, 1, 0.5), 1.0 / 12, 1e-7);
  EXPECT_NEAR(to_linear(Curve::hlg, 1, 1), 1, 1e-6);
  EXPECT_NEAR(to_linear(Curve::bt709, 1, 0.5), 0.2597, 1e-3);
  EXPECT_NEAR(to_linear(Curve::bt709, 1, 1), 1, 1e-12);
  EXPECT_NEAR(to_linear(Curve::gamma, 2.6, 0.25), std::pow(0.25, 2.6), 1e-12);
  for (const Curve curve : {Curve::pq, Curve::hlg, Curve::bt709, Curve::gamma})
    EXPECT_EQ(to_linear(curve, 2.2, -0.5), -to_linear(curve, 2.2, 0.5));
}

}  // namespace
}  // namespace welkin::io
