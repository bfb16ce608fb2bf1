#include "welkin/lobe/zonal.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "welkin/lobe/angle.h"
#include "welkin/lobe/lobe_cases.h"

namespace welkin::lobe {
namespace {

double legendre(int degree, double t) {
  double before = 1, value = t;
  if (degree == 0) return 1;
  for (int l = 1; l < degree; ++l) {
    const double next = ((2 * l + 1) * t * value - l * before) / (l + 1);
    before = value;
    value = next;
  }
  return value;
}

/// Ramamoorthi & Hanrahan 2001, eq. 18: 2/3, 1/4, 0, −1/24, 0, 1/64 …
TEST(Zonal, LambertHasItsClosedForm) {
  const std::vector<double> found = zonal_coefficients(AnyLobe::make("lambert"), 60);
  EXPECT_NEAR(found[1], 2.0 / 3, 1e-12);
  for (int l = 2; l <= 60; ++l) {
    double expected = 0;
    if (l % 2 == 0) {
      // 2 (−1)^(l/2 − 1) / ((l + 2)(l − 1)) · l! / (2^l (l/2)!²)
      expected = 2.0 / ((l + 2.0) * (l - 1.0));
      for (int k = 1; k <= l / 2; ++k) expected *= (2.0 * k - 1) / (2.0 * k);
      if (l % 4 == 0) expected = -expected;
    }
    EXPECT_NEAR(found[static_cast<std::size_t>(l)], expected, 1e-12) << l;
  }
}

/// ∫ t^n P_l dt over 0 … 1 = λ_l/(n + 1), with λ_l = λ_(l−2) · (n − l + 2)/(n + l + 1), λ_0 = 1 and λ_1 =
/// (n + 1)/(n + 2): integrate (t² − 1) P_l'.
TEST(Zonal, CosinePowersHaveTheirRecurrence) {
  for (const double n : {0.0, 0.3, 0.5, 1.0, 2.5, 7.0, 64.0, 1e4, 1e7}) {
    const std::vector<double> found =
        zonal_coefficients(AnyLobe::make("phong,exponent=" + std::to_string(n)), 300);
    std::vector<double> expected{1, (n + 1) / (n + 2)};
    for (int l = 2; l <= 300; ++l) {
      expected.push_back(expected[static_cast<std::size_t>(l) - 2] * (n - l + 2) / (n + l + 1));
    }
    for (std::size_t l = 0; l <= 300; ++l) EXPECT_NEAR(found[l], expected[l], 1e-10) << n << ' ' << l;
  }
}

/// λ_l = I_(l+½)(κ)/I_½(κ), which obeys I_(ν−1) − I_(ν+1) = 2ν/κ I_ν; run downward, where it is stable.
TEST(Zonal, VonMisesFisherIsARatioOfBesselFunctions) {
  for (const double kappa : {0.01, 1.0, 30.0, 1e3, 1e5}) {
    const int degree = 200, start = degree + 200 + static_cast<int>(8 * std::sqrt(kappa));
    std::vector<double> ratio(static_cast<std::size_t>(start) + 2, 0.0);  // I_(l+½)/I_(l−½)
    for (int l = start; l >= 1; --l) {
      const auto at = static_cast<std::size_t>(l);
      ratio[at] = 1 / ((2 * l + 1) / kappa + ratio[at + 1]);
    }
    const std::vector<double> found =
        zonal_coefficients(AnyLobe::make("vmf,kappa=" + std::to_string(kappa)), degree);
    double expected = 1;
    for (std::size_t l = 0; l <= static_cast<std::size_t>(degree); ++l) {
      if (l > 0) expected *= ratio[l];
      EXPECT_NEAR(found[l], expected, 1e-10) << kappa << ' ' << l;
    }
  }
}

/// Against the composite midpoint rule in θ extrapolated (Romberg): another quadrature, with t = cos θ.
TEST(Zonal, AgreesWithAnotherQuadrature) {
  for (const char* spec : {"ggx,roughness=1", "ggx,roughness=0.5", "ggx,roughness=0.25",
                           "blinn,roughness=0.5", "charlie,roughness=0.5", "charlie,roughness=0.1"}) {
    const AnyLobe lobe = AnyLobe::make(spec);
    const std::vector<double> found = zonal_coefficients(lobe, 40);
    const int steps = 1 << 17;
    std::vector<double> sums(41, 0.0);
    for (int i = 0; i < steps; ++i) {
      const double angle = 0.5 * kPi * (i + 0.5) / steps, t = std::cos(angle);
      const double weight = lobe.weight(s_of_angle(angle)) * std::sin(angle);
      for (int l = 0; l <= 40; l += 5) sums[static_cast<std::size_t>(l)] += weight * legendre(l, t);
    }
    // The midpoint rule's error is below 1e-9 here: h²/24 (f'(π/2) − f'(0)) with h = 1.2e-5.
    for (std::size_t l = 0; l <= 40; l += 5) EXPECT_NEAR(found[l], sums[l] / sums[0], 1e-8) << spec << l;
  }
}

TEST(Zonal, LieWithinOneAndBeginAtOne) {
  for (const AnyLobe& lobe : cases::all_lobes()) {
    const std::vector<double> found = zonal_coefficients(lobe, 500);
    ASSERT_EQ(found.size(), 501u);
    EXPECT_EQ(found[0], 1);
    for (const double coefficient : found) EXPECT_LE(std::fabs(coefficient), 1 + 1e-12) << lobe.spec();
  }
  EXPECT_EQ(zonal_coefficients(AnyLobe::make("ggx,roughness=0"), 3), (std::vector<double>(4, 1.0)));
}

/// Computed to a higher degree, with more nodes, the lower coefficients are the same.
TEST(Zonal, DoNotDependOnTheNumberOfNodes) {
  for (const AnyLobe& lobe : cases::all_lobes()) {
    const std::vector<double> few = zonal_coefficients(lobe, 37), many = zonal_coefficients(lobe, 2000);
    for (std::size_t l = 0; l < few.size(); ++l) EXPECT_NEAR(few[l], many[l], 1e-10) << lobe.spec() << l;
  }
}

/// Σ (2l + 1) λ_l P_l(t) / 4π is the normalised lobe: everywhere within the tail's bound of the degrees left
/// out, for lobes smooth enough that it reaches rounding.
TEST(Zonal, SumUpToTheLobe) {
  for (const char* spec : {"vmf,kappa=50", "vmf,kappa=1", "phong,exponent=64", "blinn,roughness=0.5"}) {
    const AnyLobe lobe = AnyLobe::make(spec);
    const std::vector<double> coefficients = zonal_coefficients(lobe, 400);
    const ZonalTail tail = zonal_tail(coefficients);
    const double integral = lobe.integral();
    for (const std::size_t degree : {8u, 20u, 60u}) {
      for (double angle = 0; angle < kPi; angle += 0.1) {
        double sum = 0;
        for (std::size_t l = 0; l <= degree; ++l) {
          sum += (2 * static_cast<double>(l) + 1) * coefficients[l] *
                 legendre(static_cast<int>(l), std::cos(angle)) / (4 * kPi);
        }
        EXPECT_NEAR(sum, lobe.weight(s_of_angle(angle)) / integral, tail.sum[degree] + 1e-6)
            << spec << ' ' << degree;
      }
    }
  }
}

TEST(Zonal, ChoosesADegreeThatTheToleranceAllows) {
  for (const char* spec : {"vmf,kappa=50", "ggx,roughness=0.5", "lambert", "charlie,roughness=0.3"}) {
    const AnyLobe lobe = AnyLobe::make(spec);
    const int degree = degree_for(lobe, 1e-4, 1000);
    const ZonalTail tail = zonal_tail(zonal_coefficients(lobe, 2 * degree + 16));
    EXPECT_LE(tail.largest[static_cast<std::size_t>(degree)], 1e-4) << spec;
    EXPECT_GT(tail.largest[static_cast<std::size_t>(degree) - 1], 1e-4) << spec;
  }
  EXPECT_EQ(degree_for(AnyLobe::make("ggx,roughness=0.01"), 1e-4, 64), 64);
  EXPECT_EQ(degree_for(AnyLobe::make("vmf,kappa=0"), 1e-4, 64), 0);
}

}  // namespace
}  // namespace welkin::lobe
