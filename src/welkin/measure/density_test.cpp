#include "welkin/measure/density.h"

#include <gtest/gtest.h>

#include <cmath>

#include "welkin/base/error.h"

namespace welkin {
namespace {

using sphere::AnyParameterization;

DensityReport report_of(const std::string& spec, int size) {
  return density_of(AnyParameterization::make(spec), size);
}

/// Maximum over minimum at infinite resolution, by each parameterization's own formula.
TEST(Density, LimitsAreThoseOfTheFormulas) {
  struct Case {
    const char* spec;
    double ratio;
  };
  for (const Case& c : {Case{"cube", 3 * std::sqrt(3.0)},        // Heidrich & Seidel 1999, §2.2
                        Case{"octahedral", 3 * std::sqrt(3.0)},  // the same integrand over a face: r⁻³
                        Case{"paraboloid", 4.0},                 // Heidrich & Seidel 1999, eq. 3
                        Case{"eac", std::sqrt(2.0)},             // 1.1781/0.8330
                        Case{"fisheye-equidistant", kPi / 2},    // θ / sin θ at 90°
                        Case{"fisheye-stereographic", 4.0},      // (1 + r²)²
                        Case{"cylinder", std::pow(2.0, 1.5)},    // sec³ of 45°
                        Case{"equal-area", 1.0}, Case{"healpix", 1.0}, Case{"octahedral-equal-area", 1.0},
                        Case{"mirror-ball", 1.0}, Case{"fisheye-equisolid", 1.0}}) {
    const DensityReport report = report_of(c.spec, 32);
    EXPECT_NEAR(report.limit_ratio / c.ratio, 1, 1e-6) << c.spec;
    EXPECT_FALSE(report.unbounded) << c.spec;
    EXPECT_LE(report.ratio, report.limit_ratio * (1 + 1e-5)) << c.spec;
  }
}

TEST(Density, APoleMakesTheRatioUnbounded) {
  for (const char* spec : {"latlong", "angular", "sky-latlong"}) {
    const DensityReport report = report_of(spec, 64);
    EXPECT_TRUE(report.unbounded) << spec;
    EXPECT_TRUE(std::isinf(report.limit_ratio)) << spec;
    EXPECT_TRUE(std::isfinite(report.ratio)) << spec;
  }
  // sin θ is ⟨sin θ⟩ = 2/π on average.
  EXPECT_NEAR(report_of("latlong", 64).limit_maximum, kPi / 2, 1e-6);
}

TEST(Density, TexelsApproachTheLimits) {
  for (const char* spec : {"cube", "octahedral", "paraboloid", "eac", "cylinder", "half-cube"}) {
    const DensityReport coarse = report_of(spec, 16), fine = report_of(spec, 512);
    EXPECT_NEAR(fine.maximum / fine.limit_maximum, 1, 0.01) << spec;
    EXPECT_NEAR(fine.minimum / fine.limit_minimum, 1, 0.01) << spec;
    EXPECT_LE(fine.limit_ratio / fine.ratio, coarse.limit_ratio / coarse.ratio) << spec;
    EXPECT_NEAR(fine.ratio, fine.maximum / fine.minimum, 1e-9) << spec;
  }
}

TEST(Density, TheValidAreaIsThatOfTheDomain) {
  const auto area = [](const char* spec) {
    return density_limits(AnyParameterization::make(spec)).valid_area;
  };
  EXPECT_EQ(area("cube"), 6);
  EXPECT_EQ(area("latlong"), 1);
  EXPECT_NEAR(area("angular"), kPi / 4, 1e-6);
  EXPECT_NEAR(area("paraboloid"), kPi / 2, 1e-6);
  EXPECT_NEAR(area("half-cube"), 0.75, 2e-4);
}

TEST(Density, RejectsSizesThatMakeNoSense) {
  EXPECT_THROW(report_of("cube", 1), Error);
  EXPECT_THROW(report_of("cube", -5), Error);
  EXPECT_THROW(report_of("cube", 1 << 20), Error);
}

}  // namespace
}  // namespace welkin
