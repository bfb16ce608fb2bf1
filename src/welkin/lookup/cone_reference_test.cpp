#include "welkin/lookup/cone_reference.h"

#include <gtest/gtest.h>

#include <cmath>

#include "welkin/base/error.h"
#include "welkin/lookup/cone_shapes.h"
#include "welkin/map/map_cases.h"
#include "welkin/math/angles.h"

namespace welkin::test {
namespace {

/// ∫ f(d) weight(d) dω over the sphere, on an equal-area grid.
double integral(const ConeWeight& weight, const cases::Function& f, int rows) {
  double sum = 0;
  for (int j = 0; j < rows; ++j) {
    const double y = 1 - (j + 0.5) * 2 / rows, r = std::sqrt(1 - y * y);
    for (int i = 0; i < 2 * rows; ++i) {
      const double a = (i + 0.5) * kPi / rows;
      const Vec3d d{r * std::sin(a), y, r * std::cos(a)};
      sum += f(d) * weight(d);
    }
  }
  return sum * 4 * kPi / (2.0 * rows * rows);
}

double one(const Vec3d&) {
  return 1;
}

TEST(VmfConcentration, KeepsTheMeanCosine) {
  for (const double sigma : {1e-3, 0.01, 0.1, 0.5, 1.0, 2.0}) {
    const double k = vmf_concentration(sigma);
    EXPECT_NEAR((1 / std::tanh(k) - 1 / k) / std::exp(-sigma * sigma), 1, 1e-8) << sigma;
  }
  EXPECT_NEAR(vmf_concentration(1e-3) * 1e-6, 1, 1e-6);
  EXPECT_NEAR(vmf_concentration(0.1), 100.5, 0.1) << "1/σ² + ½";
  EXPECT_LT(vmf_concentration(4), 1e-6);
  EXPECT_THROW(vmf_concentration(0), Error);
}

TEST(ConeWeight, HasTheIntegralOneAndTheMomentsOfItsWidths) {
  for (const auto& [wide, narrow] : {std::pair{0.1f, 0.1f}, {0.3f, 0.1f}, {1.5f, 0.2f}, {4.0f, 4.0f}}) {
    const ConeWeight weight({{1, 2, 3}, {0, 1, 0}, wide, narrow});
    EXPECT_NEAR(integral(weight, one, 400), 1, 1e-4) << wide << " " << narrow;
    // Both distributions keep exp(−σ²/2) or exp(−σ²) of first moments, which multiply.
    const Vec3d axis = normalize(Vec3d{1, 2, 3});
    const double w = static_cast<double>(wide), n = static_cast<double>(narrow);
    EXPECT_NEAR(integral(
                    weight, [&](const Vec3d& d) { return dot(axis, d); }, 400),
                std::exp(-n * n) * std::exp(-0.5 * (w * w - n * n)), 1e-4);
  }
}

TEST(ConeWeight, IsTheGaussianOfThePlaneWhereItIsNarrow) {
  const ConeWeight weight({{0, 0, 1}, {1, 0, 0}, 0.02f, 0.005f});
  const double peak = weight({0, 0, 1});
  EXPECT_NEAR(peak * 2 * kPi * 0.02 * 0.005, 1, 1e-3);
  for (const double x : {0.0, 0.02, 0.05}) {
    for (const double y : {0.0, 0.005, 0.015}) {
      const double want = std::exp(-0.5 * (x * x / 4e-4 + y * y / 2.5e-5));
      EXPECT_NEAR(weight(normalize(Vec3d{x, y, 1})) / peak, want, 3e-3) << x << " " << y;
    }
  }
}

TEST(LookUpReference, KeepsAConstantWhateverTheMap) {
  for (const std::string& spec : cases::names_and_windows()) {
    const Map map = cases::rendered(
        spec, 16, [](const Vec3d&) { return 3.25; }, 2);
    const Vec3d d = cases::direction_at(map, 0, map.width() / 2, map.height() / 2);
    const auto mean = look_up_reference(map, isotropic_cone(d, 0.3), 2);
    EXPECT_NEAR(mean[0], 3.25, 1e-12) << spec;
    EXPECT_NEAR(mean[1], 6.5, 1e-12) << spec;
  }
}

TEST(LookUpReference, IsAlikeOnEveryParameterization) {
  // Of a function of degree 1 the mean over any cone is known: d̄ = exp(−σn² − ½(σw² − σn²)) d.
  const auto slope = [](const Vec3d& d) { return 2 + d.x - 0.5 * d.y + 0.25 * d.z; };
  const EllipticalCone cone{{0.5f, -0.4f, 0.8f}, {0, 1, 0}, 0.5f, 0.25f};
  const Vec3d d = normalize(Vec3d{0.5, -0.4, 0.8});
  const double kept = std::exp(-0.0625 - 0.5 * (0.25 - 0.0625));
  const double want = 2 + kept * (slope(d) - 2);
  for (const char* spec : {"latlong", "cube", "octahedral", "healpix", "mirror-ball"}) {
    const Map map = cases::rendered(spec, 128, slope);
    EXPECT_NEAR(look_up_reference(map, cone, 2)[0], want, 2e-3) << spec;
  }
}

TEST(LookUpReference, ConvergesToTheMeanOfAQuad) {
  const Map map = cases::rendered("cube", 16, cases::checker(3));
  const QuadCone quad{{Vec3d{-0.3, 0.2, 1}, Vec3d{0.5, 0.1, 1}, Vec3d{0.4, -0.5, 1}, Vec3d{-0.2, -0.3, 1}}};
  const double fine = look_up_reference(map, quad, 64)[0];
  const double coarse_error = std::fabs(look_up_reference(map, quad, 4)[0] - fine);
  EXPECT_LT(std::fabs(look_up_reference(map, quad, 32)[0] - fine), 2e-4);
  EXPECT_LT(coarse_error, 0.02);
  // The other way around, and as what a map of another shape holds.
  const QuadCone reversed{{quad.corners[3], quad.corners[2], quad.corners[1], quad.corners[0]}};
  EXPECT_NEAR(look_up_reference(map, reversed, 64)[0], fine, 1e-12);
}

TEST(LookUpReference, OfAWholeTexelIsTheTexel) {
  for (const char* spec : {"cube", "half-cube"}) {
    Map map = cases::rendered(spec, 8, cases::waves(9, 20));
    const QuadCone quad = cone_of_area(map, 0, {.x = 2.5, .y = 4.5, .width = 0.999, .height = 0.999});
    EXPECT_NEAR(look_up_reference(map, quad, 16)[0], static_cast<double>(*map.level.chart(0).at(2, 4)), 1e-9)
        << spec;
  }
}

TEST(LookUpReference, RefusesConesWithoutArea) {
  const Map map = cases::make_map("cube", 4);
  const Vec3d z{0, 0, 1}, other{0.1, 0, 1};
  EXPECT_THROW(look_up_reference(map, QuadCone{{z, z, z, z}}, 4), Error);
  EXPECT_THROW(look_up_reference(map, QuadCone{{z, other, other, z}}, 4), Error);
  EXPECT_THROW(look_up_reference(map, EllipticalCone{{0, 0, 1}, {1, 0, 0}, 0.1f, 0}, 4), Error);
  EXPECT_THROW(look_up_reference(map, isotropic_cone(z, 0.1), 0), Error);
}

}  // namespace
}  // namespace welkin::test
