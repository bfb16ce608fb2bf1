#include "welkin/brdf/dfg.h"

#include <gtest/gtest.h>

#include "welkin/base/error.h"
#include "welkin/brdf/compensation.h"
#include "welkin/brdf/dfg_reference.h"
#include "welkin/math/gauss_legendre.h"

namespace welkin::brdf {
namespace {

constexpr GgxMasking kMaskings[] = {GgxMasking::correlated, GgxMasking::separable, GgxMasking::schlick,
                                    GgxMasking::approximate};

double visibility(double nl, double nv, double alpha, GgxMasking masking) {
  if (masking == GgxMasking::correlated) return ggx_g2_correlated(nl, nv, alpha) / (4 * nl * nv);
  if (masking == GgxMasking::separable) return ggx_g1(nl, alpha) * ggx_g1(nv, alpha) / (4 * nl * nv);
  if (masking == GgxMasking::schlick)
    return schlick_g1(nl, alpha / 2) * schlick_g1(nv, alpha / 2) / (4 * nl * nv);
  return 0.5 / (2 * nl * nv * (1 - alpha) + (nl + nv) * alpha);
}

TEST(Dfg, IsTheIntegralOverHalfVectors) {
  for (const GgxMasking masking : kMaskings) {
    for (const double roughness : {0.02, 0.1, 0.35, 0.7, 1.0}) {
      for (const double nv : {1e-6, 0.004, 0.03, 0.2, 0.6, 1.0}) {
        const double alpha = roughness * roughness;
        const SplitSum found = ggx_split_sum(nv, roughness, masking);
        const SplitSum wanted = test::ggx_by_half_vectors(
            nv, alpha, [&](double nl) { return visibility(nl, nv, alpha, masking); });
        // The promise of dfg.h.
        EXPECT_NEAR(found.one, wanted.one, 1e-6)
            << roughness << " " << nv << " " << static_cast<int>(masking);
        EXPECT_NEAR(found.fc, wanted.fc, 1e-6) << roughness << " " << nv << " " << static_cast<int>(masking);
      }
    }
  }
}

TEST(Dfg, HasItsClosedForms) {
  // α = 1 seen from above: D = 1/π, V = ½/(n·l + 1), so that ∫ = ∫ 2 n·l · ½/(1 + n·l) dn·l = 1 − ln 2.
  EXPECT_NEAR(ggx_split_sum(1, 1).one, 1 - std::log(2.0), 1e-12);
  // Correlated masking loses nothing at the horizon itself.
  for (const double roughness : {0.01, 0.3, 1.0}) EXPECT_NEAR(ggx_split_sum(0, roughness).one, 1, 1e-6);
  for (const double nv : {0.0, 0.25, 1.0}) {
    for (const GgxMasking masking : kMaskings) {
      EXPECT_EQ(ggx_split_sum(nv, 0, masking).one, 1);
      EXPECT_EQ(ggx_split_sum(nv, 0, masking).fc, std::pow(1 - nv, 5));
    }
  }
}

TEST(Dfg, IsFiniteAndBoundedInEveryCorner) {
  for (const double roughness : {0.0, 1e-16, 1e-12, 1e-8, 1e-4, 0.01, 1.0}) {
    for (const double nv : {0.0, 1e-300, 1e-16, 1e-9, 1e-4, 0.5, 1 - 1e-16, 1.0}) {
      for (const GgxMasking masking : kMaskings) {
        const SplitSum sum = ggx_split_sum(nv, roughness, masking);
        EXPECT_GE(sum.fc, 0) << nv << " " << roughness;
        EXPECT_LE(sum.fc, sum.one) << nv << " " << roughness;
        if (masking != GgxMasking::schlick && masking != GgxMasking::approximate) {
          EXPECT_LE(sum.one, 1);
        }
      }
      EXPECT_TRUE(std::isfinite(charlie_albedo(nv, roughness)));
      EXPECT_TRUE(std::isfinite(charlie_albedo(nv, roughness, ClothMasking::charlie)));
    }
  }
}

/// Towards a mirror the integrals come arbitrarily near to its own, at any n·v well above α.
TEST(Dfg, TendsToTheMirror) {
  for (const double nv : {0.05, 0.3, 0.9}) {
    EXPECT_NEAR(ggx_split_sum(nv, 1e-3).one, 1, 1e-7);
    EXPECT_NEAR(ggx_split_sum(nv, 1e-3).fc, std::pow(1 - nv, 5), 1e-7);
  }
}

TEST(Dfg, ClothIsTheIntegralOverHalfVectors) {
  for (const double roughness : {0.15, 0.4, 0.7, 1.0}) {
    for (const double nv : {0.004, 0.03, 0.2, 0.6, 1.0}) {
      const double alpha = roughness * roughness;
      const double neubelt =
          test::charlie_by_half_vectors(nv, alpha, [&](double nl) { return 0.25 / (nl + nv - nl * nv); });
      EXPECT_NEAR(charlie_albedo(nv, roughness), neubelt, 1e-6 * std::max(1.0, neubelt))
          << roughness << " " << nv;
      const double charlie = test::charlie_by_half_vectors(
          nv, alpha, [&](double nl) { return charlie_visibility(nl, nv, alpha); });
      EXPECT_NEAR(charlie_albedo(nv, roughness, ClothMasking::charlie), charlie,
                  1e-5 * std::max(1.0, charlie))
          << roughness << " " << nv;
    }
  }
}

TEST(Dfg, ClothIsTheIntegralAtSmallRoughnessToo) {
  for (const double roughness : {0.004, 0.012, 0.03, 0.08}) {
    for (const double nv : {1e-4, 0.004, 0.012, 0.05, 0.2}) {
      const double alpha = roughness * roughness;
      const double wanted =
          test::charlie_by_half_vectors(nv, alpha, [&](double nl) { return 0.25 / (nl + nv - nl * nv); });
      EXPECT_NEAR(charlie_albedo(nv, roughness), wanted, 2e-5 * std::max(1.0, wanted))
          << roughness << " " << nv;
    }
  }
}

/// Seen from above, n·h = v·h = cos θ/2 and Neubelt's V = ¼: the integral is ½ (2 + 1/α) ∫ s^p (1 − 2s) ds
/// over s = sin²θ/2 from 0 to ½, with p = 1/2α.
TEST(Dfg, ClothHasItsClosedForm) {
  for (const double roughness : {0.3, 0.5, 1.0}) {
    const double p = 0.5 / (roughness * roughness);
    EXPECT_NEAR(charlie_albedo(1, roughness), std::pow(0.5, p + 1) / (p + 2), 1e-9) << roughness;
  }
}

TEST(Dfg, DisneysDiffuseIsItsIntegral) {
  for (const double roughness : {0.0, 0.5, 1.0}) {
    for (const double nv : {0.0, 0.3, 1.0}) {
      const double sv = std::sqrt(1 - nv * nv);
      const double wanted = test::adaptive(
          [&](double nl) {
            const double sl = std::sqrt(1 - nl * nl);
            return test::adaptive(
                [&](double phi) {
                  const double lh2 = 0.5 * (1 + nl * nv + sl * sv * std::cos(phi)),
                               g = 2 * roughness * lh2 - 0.5;
                  return (1 + g * std::pow(1 - nl, 5)) * (1 + g * std::pow(1 - nv, 5)) * nl * 2 / kPi;
                },
                0, kPi, 1e-12);
          },
          0, 1, 1e-11);
      EXPECT_NEAR(disney_diffuse_albedo(nv, roughness), wanted, 1e-10) << roughness << " " << nv;
    }
  }
}

TEST(Dfg, AverageAlbedoIsTheMean) {
  for (const GgxMasking masking : {GgxMasking::correlated, GgxMasking::separable}) {
    for (const double roughness : {0.2, 0.6, 1.0}) {
      const double wanted = test::adaptive(
          [&](double mu) { return 2 * mu * ggx_split_sum(mu, roughness, masking).one; }, 0, 1, 1e-8);
      EXPECT_NEAR(ggx_average_albedo(roughness, masking), wanted, 1e-6) << roughness;
    }
  }
  EXPECT_EQ(ggx_average_albedo(0), 1);
}

/// A white furnace: with the compensation, a surface that absorbs nothing reflects all.
TEST(Compensation, LosesNothingOfAWhiteSurface) {
  const QuadratureRule rule = gauss_legendre(32);
  for (const double roughness : {0.2, 0.6, 1.0}) {
    const double average = ggx_average_albedo(roughness);
    for (const double nv : {0.01, 0.3, 1.0}) {
      const SplitSum sum = ggx_split_sum(nv, roughness);
      EXPECT_NEAR(sum.one * turquin_factor(sum.one, 1), 1, 1e-12);
      EXPECT_NEAR(fdez_aguera_reflectance(sum, 1), 1, 1e-12);
      double more = 0;
      for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
        const double mu = 0.5 * (1 + rule.nodes[i]);
        more +=
            rule.weights[i] * kPi * mu * kulla_conty_lobe(ggx_split_sum(mu, roughness).one, sum.one, average);
      }
      // E's slope at the horizon costs Gauss's rule of 32 its last digits.
      EXPECT_NEAR(sum.one + more, 1, 1e-5) << roughness << " " << nv;
    }
    EXPECT_NEAR(kulla_conty_fresnel(1, average), 1, 1e-12);
  }
  EXPECT_EQ(kulla_conty_lobe(1, 1, 1), 0);
}

/// What isn't white reflects less, but more than what is scattered once.
TEST(Compensation, AddsLightAndNotTooMuch) {
  const SplitSum sum = ggx_split_sum(0.4, 0.9);
  for (const double f0 : {0.04, 0.5, 0.9}) {
    for (const double total :
         {fdez_aguera_reflectance(sum, f0), sum.reflectance(f0) * turquin_factor(sum.one, f0)}) {
      EXPECT_GT(total, sum.reflectance(f0));
      EXPECT_LT(total, 1);
    }
  }
  EXPECT_NEAR(average_fresnel(0.2, 0.9), 0.2 + 0.7 / 21, 1e-15);
  EXPECT_EQ(sheen_albedo_scaling(0, 5, 5), 1);
  EXPECT_EQ(sheen_albedo_scaling(1, 5, 0.1), 0);
  EXPECT_NEAR(sheen_albedo_scaling(0.5, 0.2, 0.4), 0.8, 1e-15);
}

TEST(Dfg, RefusesWhatIsNoCosineOrRoughness) {
  for (const double bad : {-1e-9, 1.0000001, double{NAN}, double{INFINITY}}) {
    EXPECT_THROW(ggx_split_sum(bad, 0.5), Error);
    EXPECT_THROW(ggx_split_sum(0.5, bad), Error);
    EXPECT_THROW(ggx_average_albedo(bad), Error);
    EXPECT_THROW(charlie_albedo(bad, 0.5), Error);
    EXPECT_THROW(charlie_albedo(0.5, bad), Error);
    EXPECT_THROW(disney_diffuse_albedo(bad, 0.5), Error);
  }
}

}  // namespace
}  // namespace welkin::brdf
