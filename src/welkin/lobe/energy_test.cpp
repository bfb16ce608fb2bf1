#include "welkin/lobe/energy.h"

#include <gtest/gtest.h>

#include "welkin/lobe/angle.h"
#include "welkin/lobe/lobe_cases.h"

namespace welkin::lobe {
namespace {

/// Lambert: sin²θ = share; cos^n: 1 − cos^(n+1) θ = share; an even sphere: s/2 = share. Error 1e-9 radians.
TEST(Energy, ConesMatchTheClosedForms) {
  for (const double share : {0.01, 0.5, 0.9, 0.99}) {
    EXPECT_NEAR(energy_cone_angle(AnyLobe::make("lambert"), share), std::asin(std::sqrt(share)), 1e-9);
    for (const double n : {0.0, 2.5, 50.0, 1e6}) {
      const double cosine = std::pow(1 - share, 1 / (n + 1));
      EXPECT_NEAR(energy_cone_angle(AnyLobe::make("phong,exponent=" + std::to_string(n)), share),
                  angle_of_s(1 - cosine), 1e-9);
    }
    EXPECT_NEAR(energy_cone_angle(AnyLobe::make("vmf,kappa=0"), share), angle_of_s(2 * share), 1e-9);
  }
}

TEST(Energy, GrowsWithItsShareUpToTheLobesEnd) {
  for (const AnyLobe& lobe : cases::all_lobes()) {
    double before = 0;
    for (double share = 0.05; share < 1; share += 0.05) {
      const double angle = energy_cone_angle(lobe, share);
      EXPECT_GT(angle, before) << lobe.spec() << ' ' << share;
      before = angle;
    }
    EXPECT_LE(before, kPi) << lobe.spec();
  }
  EXPECT_EQ(energy_cone_angle(AnyLobe::make("ggx,roughness=0"), 0.5), 0);
}

}  // namespace
}  // namespace welkin::lobe
