#include "welkin/brdf/lobe_sum.h"

#include <gtest/gtest.h>

#include <cmath>

#include "welkin/base/error.h"

namespace welkin::brdf {
namespace {

std::vector<lobe::AnyLobe> widths() {
  std::vector<lobe::AnyLobe> levels;
  for (const char* spec :
       {"vmf,kappa=4000", "vmf,kappa=1000", "vmf,kappa=250", "vmf,kappa=60", "vmf,kappa=15"})
    levels.push_back(lobe::AnyLobe::make(spec));
  return levels;
}

double sum_of_weights(const std::vector<LobeTerm>& terms) {
  double sum = 0;
  for (const LobeTerm& term : terms) sum += term.weight;
  return sum;
}

/// A BRDF whose lobe is a sum of two of the basis is found again.
TEST(LobeSum, FindsTheLobesOfASum) {
  constexpr double kCosine = 0.6, kFirst = 0.1, kSecond = 0.8;
  const auto lobe = [](const Vec3d& light, double tilt, double kappa) {
    const Vec3d away = light - tilted_direction(kCosine, tilt);
    return kappa * std::exp(-0.5 * kappa * dot(away, away));
  };
  const AnyBrdf brdf = AnyBrdf::from_function("two", 0.05, [&](const Vec3d&, const Vec3d& light) {
    return (0.7 * lobe(light, kFirst, 250) + 0.3 * lobe(light, kSecond, 60)) / light.z;
  });
  const std::vector<LobeTerm> terms = fit_lobe_sum(brdf, kCosine, LobeBasis(widths()), 2);
  ASSERT_EQ(terms.size(), 2u);
  EXPECT_NEAR(terms[0].weight, 0.7, 0.02);
  EXPECT_NEAR(terms[0].level, 2, 0.06);
  EXPECT_NEAR(terms[0].tilt, kFirst, 0.006);
  EXPECT_NEAR(terms[1].weight, 0.3, 0.02);
  EXPECT_NEAR(terms[1].level, 3, 0.06);
  EXPECT_NEAR(terms[1].tilt, kSecond, 0.012);
}

TEST(LobeSum, WeightsAddUpAndAreNotNegative) {
  std::vector<lobe::AnyLobe> chain;
  for (int k = 0; k <= 8; ++k) chain.push_back(lobe::AnyLobe::make("ggx").with_roughness(k / 8.0));
  const LobeBasis basis(chain);
  EXPECT_EQ(basis.levels(), 9);
  for (const double roughness : {0.2, 0.6, 1.0}) {
    for (const double cosine : {0.05, 0.5, 1.0}) {
      const AnyBrdf brdf = AnyBrdf::make("ggx").with_roughness(roughness);
      for (const int count : {1, 3, 8}) {
        const std::vector<LobeTerm> terms = fit_lobe_sum(brdf, cosine, basis, count);
        EXPECT_GE(terms.size(), 1u);
        EXPECT_LE(terms.size(), static_cast<std::size_t>(count));
        EXPECT_NEAR(sum_of_weights(terms), 1, 1e-9);
        for (const LobeTerm& term : terms) {
          EXPECT_GT(term.weight, 0);
          EXPECT_GE(term.level, 0);
          EXPECT_LE(term.level, 8);
        }
      }
    }
  }
}

/// Where the surface is seen along its normal, GGX's lobe is nearly the one that engines filter with.
TEST(LobeSum, OneLobeSufficesAlongTheNormal) {
  std::vector<lobe::AnyLobe> chain;
  for (int k = 0; k <= 8; ++k) chain.push_back(lobe::AnyLobe::make("ggx").with_roughness(k / 8.0));
  const std::vector<LobeTerm> terms =
      fit_lobe_sum(AnyBrdf::make("ggx,roughness=0.375"), 1, LobeBasis(chain), 1);
  ASSERT_EQ(terms.size(), 1u);
  EXPECT_NEAR(terms[0].level, 3, 0.3);  // masking widens it a little
  EXPECT_NEAR(terms[0].tilt, 0, 0.01);
}

TEST(LobeSum, WhatCannotBeFitted) {
  EXPECT_THROW(LobeBasis({}), Error);
  EXPECT_THROW(LobeBasis(widths(), 0), Error);
  EXPECT_THROW(fit_lobe_sum(AnyBrdf::make("ggx"), 0.5, LobeBasis(widths()), 0), Error);
  EXPECT_THROW(fit_lobe_sum(AnyBrdf::make("ggx"), 0, LobeBasis(widths()), 3), Error);
}

}  // namespace
}  // namespace welkin::brdf
