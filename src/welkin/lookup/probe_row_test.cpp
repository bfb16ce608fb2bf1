#include "welkin/lookup/probe_row.h"

#include <gtest/gtest.h>

#include <cmath>

#include "welkin/lookup/gaussian_boxes.h"

namespace welkin::test {
namespace {

TEST(ProbeRow, HasTheSharesOfOneAndTheVarianceOfTheCone) {
  for (const int most : {1, 2, 3, 4, 8, 16, 64}) {
    for (const float aspect : {1.0f, 1.001f, 1.2f, 2.0f, 4.0f, 16.0f, 1000.0f}) {
      const float narrow = 0.01f, wide = narrow * aspect;
      const ProbeRow row = probe_row(wide, narrow, most);
      ASSERT_GE(row.count, 1);
      ASSERT_LE(row.count, most);
      float total = 0, variance = row.sigma * row.sigma;
      for (int i = 0; i < row.count; ++i) {
        const auto k = static_cast<std::size_t>(i);
        total += row.share[k];
        variance += row.share[k] * row.angle[k] * row.angle[k];
      }
      EXPECT_NEAR(static_cast<double>(total), 1, 1e-6);
      EXPECT_GE(row.sigma, narrow);
      if (most > 1) {
        EXPECT_NEAR(std::sqrt(static_cast<double>(variance)) / static_cast<double>(wide), 1, 1e-3)
            << most << " " << aspect;
      }
    }
  }
  EXPECT_EQ(probe_row(0, 0, 16).count, 1);
  EXPECT_EQ(probe_row(1, 0, 16).count, 16);
}

TEST(GaussianBoxes, HaveTheSharesOfOneAndTheVarianceOfOne) {
  for (int count = 1; count <= kMostBoxes; ++count) {
    double total = 0, variance = 0;
    for (int k = 0; k < count; ++k) {
      const GaussianBox& box = kGaussianBoxes[count - 1][k];
      total += box.share;
      variance += box.share * box.half * box.half / 3;
    }
    EXPECT_NEAR(total, 1, 1e-9);
    EXPECT_NEAR(variance, 1, 1e-8);
  }
}

}  // namespace
}  // namespace welkin::test
