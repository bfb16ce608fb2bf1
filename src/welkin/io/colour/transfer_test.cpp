#include "welkin/io/colour/transfer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "welkin/io/colour/srgb_encoder.h"

namespace welkin::io {
namespace {

TEST(Transfer, KnownValues) {
  EXPECT_EQ(srgb_to_linear(0), 0);
  EXPECT_EQ(srgb_to_linear(1), 1);
  EXPECT_DOUBLE_EQ(linear_to_srgb(1), 1);
  EXPECT_NEAR(srgb_to_linear(0.5), 0.21404114048223255, 1e-15);
  EXPECT_NEAR(linear_to_srgb(0.18), 0.46135612950044164, 1e-15);
}

// The standard rounds both knees to a few digits, which leaves a step of 3e-8 between them.
TEST(Transfer, InverseBothWays) {
  for (int k = -2000; k <= 2000; ++k) {
    const double x = k / 1000.0;
    EXPECT_NEAR(srgb_to_linear(linear_to_srgb(x)), x, 4e-8);
    EXPECT_NEAR(linear_to_srgb(srgb_to_linear(x)), x, 4e-8);
  }
}

TEST(Transfer, OddAroundZero) {
  for (const double x : {0.001, 0.2, 0.9, 3.0}) {
    EXPECT_EQ(srgb_to_linear(-x), -srgb_to_linear(x));
    EXPECT_EQ(linear_to_srgb(-x), -linear_to_srgb(x));
  }
}

TEST(Transfer, TablesAreTheFormulasRounded) {
  ASSERT_EQ(srgb8_to_linear().size(), 256u);
  ASSERT_EQ(srgb16_to_linear().size(), 65536u);
  ASSERT_EQ(unorm8_to_float().size(), 256u);
  ASSERT_EQ(unorm16_to_float().size(), 65536u);
  for (std::size_t k = 0; k < 65536; ++k) {
    const double x = static_cast<double>(k) / 65535;
    ASSERT_EQ(srgb16_to_linear()[k], static_cast<float>(srgb_to_linear(x)));
    ASSERT_EQ(unorm16_to_float()[k], static_cast<float>(x));
  }
  for (std::size_t k = 0; k < 256; ++k) {
    const double x = static_cast<double>(k) / 255;
    ASSERT_EQ(srgb8_to_linear()[k], static_cast<float>(srgb_to_linear(x)));
    ASSERT_EQ(unorm8_to_float()[k], static_cast<float>(x));
  }
}

int rounded_formula(int levels, float x) {
  return static_cast<int>(std::floor(levels * linear_to_srgb(x) + 0.5));
}

TEST(SrgbEncoder, EqualsTheRoundedFormulaAtEveryThreshold) {
  for (const auto& [levels, encoder] :
       {std::pair{255, &srgb8_encoder()}, std::pair{65535, &srgb16_encoder()}}) {
    for (int code = 1; code <= levels; ++code) {
      float x = static_cast<float>(srgb_to_linear((code - 0.5) / levels));
      for (int i = 0; i < 4; ++i) x = std::nextafter(x, 0.0f);
      for (int i = 0; i < 9; ++i, x = std::nextafter(x, 2.0f)) {
        ASSERT_EQ((*encoder)(x), rounded_formula(levels, x)) << "x = " << x;
      }
    }
  }
}

TEST(SrgbEncoder, EqualsTheRoundedFormulaEverywhere) {
  std::mt19937 random(1);
  // Uniform in the bits, so in every octave alike: 0 … 1.
  std::uniform_int_distribution<std::uint32_t> bits(0, 0x3f800000);
  for (int i = 0; i < 500000; ++i) {
    const float x = std::bit_cast<float>(i == 0 ? 0x3f800000 : bits(random));
    ASSERT_EQ(srgb8_encoder()(x), rounded_formula(255, x)) << "x = " << x;
    ASSERT_EQ(srgb16_encoder()(x), rounded_formula(65535, x)) << "x = " << x;
  }
}

TEST(SrgbEncoder, NegativeZeroIsZero) {
  EXPECT_EQ(srgb8_encoder()(-0.0f), 0);
  EXPECT_EQ(srgb16_encoder()(-0.0f), 0);
}

TEST(SrgbEncoder, InvertsTheTables) {
  for (std::size_t k = 0; k < 65536; ++k)
    ASSERT_EQ(srgb16_encoder()(srgb16_to_linear()[k]), static_cast<int>(k));
  for (std::size_t k = 0; k < 256; ++k) ASSERT_EQ(srgb8_encoder()(srgb8_to_linear()[k]), static_cast<int>(k));
}

}  // namespace
}  // namespace welkin::io
