#include "welkin/io/colour/code_points.h"

#include <gtest/gtest.h>

namespace welkin::io::test {
namespace {

struct Said {
  Declared declared;
  FileInfo info;
};

Said said(int primaries, int transfer) {
  Said both;
  // What an earlier chunk of the file may have said is replaced.
  both.declared.curve = Curve::hlg;
  both.declared.gamma = 3;
  both.declared.primaries = chromaticities_of(8);
  declare_code_points(primaries, transfer, both.declared, both.info);
  return both;
}

TEST(CodePoints, TransferFunctionsAreNamed) {
  const struct {
    int number;
    Colour colour;
    Curve curve;
    double gamma;
  } table[] = {
      {1, Colour::linear, Curve::bt709, 1},    {2, Colour::srgb, Curve::none, 1},
      {4, Colour::linear, Curve::gamma, 2.2},  {5, Colour::linear, Curve::gamma, 2.8},
      {6, Colour::linear, Curve::bt709, 1},    {8, Colour::linear, Curve::none, 1},
      {11, Colour::linear, Curve::bt709, 1},   {12, Colour::linear, Curve::bt709, 1},
      {13, Colour::srgb, Curve::none, 1},      {14, Colour::linear, Curve::bt709, 1},
      {15, Colour::linear, Curve::bt709, 1},   {16, Colour::linear, Curve::pq, 1},
      {17, Colour::linear, Curve::gamma, 2.6}, {18, Colour::linear, Curve::hlg, 1},
  };
  for (const auto& row : table) {
    SCOPED_TRACE(row.number);
    const Said both = said(1, row.number);
    EXPECT_EQ(both.info.colour, row.colour);
    EXPECT_EQ(both.declared.curve, row.curve);
    EXPECT_EQ(both.declared.gamma, row.gamma);
    EXPECT_EQ(both.declared.primaries, std::nullopt);
    EXPECT_TRUE(both.info.warnings.empty());
  }
}

TEST(CodePoints, TransferFunctionsThatAreNotUndoneAreTold) {
  for (const auto& [number, meaning] : {std::pair{0, "reserved"},
                                        {3, "reserved"},
                                        {7, "SMPTE 240M"},
                                        {9, "logarithmic, 100:1"},
                                        {10, "logarithmic, 316:1"},
                                        {19, "reserved"},
                                        {255, "reserved"}}) {
    const Said both = said(1, number);
    EXPECT_EQ(both.info.colour, Colour::srgb);
    EXPECT_EQ(both.declared.curve, Curve::none);
    ASSERT_EQ(both.info.warnings.size(), 1u);
    EXPECT_EQ(both.info.warnings[0], "its transfer function is number " + std::to_string(number) +
                                         " of ITU-T H.273 (" + meaning +
                                         "), which is not undone; sRGB is assumed");
  }
}

// Table 2 of ITU-T H.273 (2021).
TEST(CodePoints, PrimariesHaveTheirChromaticities) {
  const struct {
    int number;
    Chromaticities of;
  } table[] = {
      {1, {{0.640, 0.330}, {0.300, 0.600}, {0.150, 0.060}, {0.3127, 0.3290}}},
      {4, {{0.67, 0.33}, {0.21, 0.71}, {0.14, 0.08}, {0.310, 0.316}}},
      {5, {{0.64, 0.33}, {0.29, 0.60}, {0.15, 0.06}, {0.3127, 0.3290}}},
      {6, {{0.630, 0.340}, {0.310, 0.595}, {0.155, 0.070}, {0.3127, 0.3290}}},
      {7, {{0.630, 0.340}, {0.310, 0.595}, {0.155, 0.070}, {0.3127, 0.3290}}},
      {8, {{0.681, 0.319}, {0.243, 0.692}, {0.145, 0.049}, {0.310, 0.316}}},
      {9, {{0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}, {0.3127, 0.3290}}},
      {10, {{1, 0}, {0, 1}, {0, 0}, {1.0 / 3, 1.0 / 3}}},
      {11, {{0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}, {0.314, 0.351}}},
      {12, {{0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}, {0.3127, 0.3290}}},
      {22, {{0.630, 0.340}, {0.295, 0.605}, {0.155, 0.077}, {0.3127, 0.3290}}},
  };
  for (const auto& row : table) {
    SCOPED_TRACE(row.number);
    EXPECT_EQ(chromaticities_of(row.number), row.of);
    const Said both = said(row.number, 13);
    EXPECT_TRUE(both.info.warnings.empty());
    if (row.number == 1) {
      EXPECT_EQ(both.declared.primaries, std::nullopt);
    } else {
      EXPECT_EQ(both.declared.primaries, row.of);
    }
  }
}

TEST(CodePoints, PrimariesThatAreNotKnownAreTold) {
  EXPECT_EQ(said(2, 2).declared.primaries, std::nullopt);
  EXPECT_TRUE(said(2, 2).info.warnings.empty());
  for (const int number : {0, 3, 13, 21, 23, 255}) {
    EXPECT_EQ(chromaticities_of(number), std::nullopt);
    const Said both = said(number, 13);
    EXPECT_EQ(both.declared.primaries, std::nullopt);
    ASSERT_EQ(both.info.warnings.size(), 1u);
    EXPECT_EQ(both.info.warnings[0], "its colour primaries are number " + std::to_string(number) +
                                         " of ITU-T H.273 (reserved); BT.709's are assumed");
  }
}

}  // namespace
}  // namespace welkin::io::test
