#include "welkin/prefilter/roughness_levels.h"

#include <gtest/gtest.h>

#include "welkin/base/error.h"

namespace welkin {
namespace {

using lobe::AnyLobe;

TEST(RoughnessLevels, AreTheCurvesAndTheChains) {
  const lobe::RoughnessCurve linear = lobe::RoughnessCurve::from_name("linear");
  const auto levels = roughness_levels(AnyLobe::make("ggx"), linear, {9, 5}, 3);
  ASSERT_EQ(levels.size(), 3u);
  EXPECT_TRUE(levels[0].lobe.is_mirror());
  EXPECT_EQ(roughness_of(levels[1].lobe), 0.5);
  EXPECT_EQ(roughness_of(levels[2].lobe), 1);
  EXPECT_EQ(levels[1].size.width, 4);
  EXPECT_EQ(levels[2].size.height, 1);
  // Phong's roughness is 1/exponent.
  EXPECT_EQ(roughness_of(roughness_levels(AnyLobe::make("phong"), linear, {4, 4}, 3)[1].lobe), 0.5);
  EXPECT_FALSE(roughness_of(AnyLobe::make("lambert")).has_value());
}

TEST(RoughnessLevels, WithoutAMirrorBeginAtHalfOfTheNextLevel) {
  const AnyLobe charlie = AnyLobe::make("charlie");
  const auto named = [&](const char* curve, int count) {
    return roughness_levels(charlie, lobe::RoughnessCurve::from_name(curve), {256, 256}, count);
  };
  EXPECT_EQ(roughness_of(named("linear", 9)[0].lobe), 0.0625);
  EXPECT_EQ(roughness_of(named("linear", 9)[1].lobe), 0.125);
  EXPECT_EQ(roughness_of(named("linear", 1)[0].lobe), 0.5);
  EXPECT_GE(*roughness_of(named("unreal", 9)[0].lobe), 0.01);
  EXPECT_THROW(named("0,0.5", 2), Error);
  EXPECT_THROW(named("0.1,0.5", 3), Error);
  EXPECT_THROW(roughness_levels(AnyLobe::make("vmf"), lobe::RoughnessCurve::from_name("linear"), {4, 4}, 2),
               Error);
}

}  // namespace
}  // namespace welkin
