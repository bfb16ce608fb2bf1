#include "welkin/brdf/fresnel.h"

#include <gtest/gtest.h>

#include <cmath>

#include "welkin/base/error.h"

namespace welkin::brdf {
namespace {

/// The formula as Heidrich & Seidel 1999 print it, in extended precision.
double as_printed(double cosine, double eta) {
  const long double c = cosine, n = eta, square = n * n + c * c - 1;
  if (square < 0) return 1;
  const long double g = std::sqrt(square), ratio = (g - c) / (g + c),
                    other = (c * (g + c) - 1) / (c * (g - c) + 1);
  return static_cast<double>(0.5L * ratio * ratio * (1 + other * other));
}

/// The three indices of figure 8, and others, total reflection too.
TEST(FresnelTable, IsThePrintedFormulaRounded) {
  for (const double eta : {1.5, 5.0, 200.0, 1.0001, 0.75}) {
    for (const TexelPlacement placement : {TexelPlacement::ends, TexelPlacement::centres}) {
      const std::vector<float> table = fresnel_table({eta, 0}, 256, placement);
      ASSERT_EQ(table.size(), 256u);
      for (int i = 0; i < 256; ++i) {
        const double c = texel_coordinate(i, 256, placement);
        // Half an ulp of a float below 1.
        EXPECT_NEAR(table[static_cast<std::size_t>(i)], as_printed(c, eta), 3.1e-8) << eta << " " << c;
        EXPECT_NEAR(fresnel(c, {eta, 0}), as_printed(c, eta), 1e-14) << eta << " " << c;
      }
    }
  }
}

/// What figure 8 shows: glass reflects at grazing angles only, a dense medium everywhere.
TEST(FresnelTable, ShowsWhatFigure8Shows) {
  const auto facing = [](double eta) { return fresnel_table({eta, 0}, 64).back(); };
  const auto grazing = [](double eta) { return fresnel_table({eta, 0}, 64).front(); };
  EXPECT_NEAR(facing(1.5), 0.04, 1e-7);
  EXPECT_NEAR(facing(5), 4.0 / 9, 1e-7);
  EXPECT_NEAR(facing(200), 199.0 * 199 / (201.0 * 201), 1e-7);
  for (const double eta : {1.5, 5.0, 200.0}) EXPECT_EQ(grazing(eta), 1);
  for (double c = 0.25; c <= 1; c += 0.01) EXPECT_GT(fresnel(c, {200, 0}), 0.95) << c;
  // Even there one polarisation has Brewster's angle, 89.7°.
  EXPECT_NEAR(fresnel(1 / std::sqrt(1 + 200.0 * 200), {200, 0}), 0.5, 1e-4);
}

TEST(FresnelTable, ReflectsAllBeyondTheCriticalAngle) {
  const Boundary into_air{1 / 1.5, 0};
  const double critical = critical_cosine(into_air);
  EXPECT_NEAR(critical, std::cos(std::asin(1 / 1.5)), 1e-15);
  EXPECT_EQ(fresnel(critical * 0.999, into_air), 1);
  EXPECT_LT(fresnel(critical * 1.001, into_air), 1);
  EXPECT_EQ(critical_cosine({1.5, 0}), 0);
}

/// What comes in from the other side at the refracted angle is reflected alike.
TEST(Fresnel, IsTheSameFromBothSides) {
  for (const double eta : {1.2, 1.5, 5.0}) {
    for (double c = 0.01; c <= 1; c += 0.09) {
      const double inner = std::sqrt(1 - (1 - c * c) / (eta * eta));
      EXPECT_NEAR(fresnel(c, {eta, 0}), fresnel(inner, {1 / eta, 0}), 1e-11) << eta << " " << c;
    }
  }
}

/// Gold at 650 and 450 nm, from Johnson & Christy 1972: red is reflected more than blue, by known amounts.
TEST(Fresnel, OfGoldIsYellow) {
  EXPECT_NEAR(fresnel(1, {0.14, 3.697}), 0.964, 0.003);
  EXPECT_NEAR(fresnel(1, {1.40, 1.88}), 0.397, 0.003);
}

TEST(FresnelTable, ItsErrorFallsWithTheSquareOfItsTexels) {
  const auto error = [](int count) { return fresnel_table_error({1.5, 0}, fresnel_table({1.5, 0}, count)); };
  const double coarse = error(32), fine = error(64), finer = error(128);
  EXPECT_NEAR(coarse / fine, 4, 0.5);
  EXPECT_NEAR(fine / finer, 4, 0.5);
  // Texel centres miss the grazing end, where F is steepest.
  const double centred = fresnel_table_error({1.5, 0}, fresnel_table({1.5, 0}, 64, TexelPlacement::centres),
                                             TexelPlacement::centres);
  EXPECT_GT(centred, 5 * fine);
}

TEST(Fresnel, RefusesWhatIsNoIndexOrAngle) {
  for (const Boundary& bad :
       {Boundary{0, 0}, Boundary{-1.5, 0}, Boundary{NAN, 0}, Boundary{INFINITY, 0}, Boundary{1e10, 0},
        Boundary{1.5, -1}, Boundary{1.5, NAN}, Boundary{1.5, 1e10}}) {
    EXPECT_THROW(check(bad), Error) << bad.n << " " << bad.k;
    EXPECT_THROW(fresnel_table(bad, 16), Error);
  }
  EXPECT_THROW(fresnel(1.1, {}), Error);
  EXPECT_THROW(fresnel(-0.1, {}), Error);
  EXPECT_THROW(fresnel(NAN, {}), Error);
  for (const int count : {-1, 0, 65537, 2000000000}) EXPECT_THROW(fresnel_table({}, count), Error);
  EXPECT_NEAR(fresnel(0.5, {kLargestIndex, 0}), 1, 1e-8);
  EXPECT_NEAR(fresnel(0.5, {1 / kLargestIndex, 0}), 1, 0);
  EXPECT_TRUE(std::isfinite(fresnel(0.3, {kLargestIndex, kLargestIndex})));
  EXPECT_EQ(fresnel_table({}, 1).size(), 1u);
}

}  // namespace
}  // namespace welkin::brdf
