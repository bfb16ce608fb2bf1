#include "welkin/brdf/microfacet.h"

#include <gtest/gtest.h>

#include <complex>
#include <functional>

#include "welkin/math/gauss_legendre.h"

namespace welkin::brdf {
namespace {

constexpr double kAlphas[] = {0.01, 0.1, 0.3, 0.7, 1};
constexpr double kCosines[] = {0.001, 0.05, 0.3, 0.7, 0.99, 1};

/// ∫ f(cos θ) dω over the hemisphere, with panels that halve toward both ends.
double over_hemisphere(const std::function<double(double cosine, double sine_squared)>& f) {
  const QuadratureRule rule = gauss_legendre(20);
  double sum = 0;
  const auto panel = [&](double low, double high) {
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      const double angle = 0.5 * (low + high + (high - low) * rule.nodes[i]);
      const double sine = std::sin(angle), cosine = std::cos(angle);
      sum += rule.weights[i] * (high - low) / 2 * 2 * kPi * sine * f(cosine, sine * sine);
    }
  };
  for (double high = kPi / 4; high > 1e-9; high /= 2) panel(high / 2, high);
  for (double away = kPi / 4; away > 1e-6; away /= 2) panel(kPi / 2 - away, kPi / 2 - away / 2);
  return sum;
}

TEST(Microfacet, FacetsCoverTheirPlaneOnce) {
  for (const double alpha : kAlphas) {
    const double ggx = over_hemisphere(
        [&](double cosine, double s2) { return ggx_distribution_from_sine(s2, alpha) * cosine; });
    EXPECT_NEAR(ggx, 1, 1e-9) << alpha;
    const double charlie = over_hemisphere(
        [&](double cosine, double s2) { return charlie_distribution_from_sine(s2, alpha) * cosine; });
    EXPECT_NEAR(charlie, 1, 1e-9) << alpha;
  }
}

TEST(Microfacet, CosinesGiveWhatSinesDo) {
  for (const double alpha : kAlphas) {
    for (const double nh : kCosines) {
      const double s2 = 1 - nh * nh;
      EXPECT_NEAR(ggx_distribution(nh, alpha), ggx_distribution_from_sine(s2, alpha),
                  1e-10 * ggx_distribution(nh, alpha));
      EXPECT_NEAR(charlie_distribution(nh, alpha), charlie_distribution_from_sine(s2, alpha),
                  1e-10 * (1 + charlie_distribution(nh, alpha)));
    }
  }
}

TEST(Microfacet, MaskingIsTheLambdasAndNeverMakesLight) {
  for (const double alpha : kAlphas) {
    for (const double nl : kCosines) {
      EXPECT_NEAR(ggx_g1(nl, alpha), 1 / (1 + ggx_lambda(nl, alpha)), 1e-12);
      for (const double nv : kCosines) {
        const double correlated = ggx_g2_correlated(nl, nv, alpha),
                     separable = ggx_g2_separable(nl, nv, alpha);
        EXPECT_NEAR(correlated, 1 / (1 + ggx_lambda(nl, alpha) + ggx_lambda(nv, alpha)), 1e-12);
        // Facets that are high are seen from both sides: correlated masking hides less, and never less than
        // one side alone.
        EXPECT_GE(correlated, separable * (1 - 1e-12));
        EXPECT_LE(correlated, std::min(ggx_g1(nl, alpha), ggx_g1(nv, alpha)) * (1 + 1e-12));
        EXPECT_NEAR(ggx_visibility_correlated(nl, nv, alpha) * 4 * nl * nv, correlated, 1e-12);
        EXPECT_NEAR(ggx_visibility_separable(nl, nv, alpha) * 4 * nl * nv, separable, 1e-12);
        EXPECT_NEAR(schlick_visibility(nl, nv, alpha / 2) * 4 * nl * nv,
                    schlick_g1(nl, alpha / 2) * schlick_g1(nv, alpha / 2), 1e-12);
        EXPECT_EQ(ggx_visibility_correlated(nl, nv, alpha), ggx_visibility_correlated(nv, nl, alpha));
      }
    }
  }
}

TEST(Microfacet, TheRootlessVisibilityIsExactWhereItMustBe) {
  for (const double nl : kCosines) {
    for (const double nv : kCosines) {
      EXPECT_NEAR(ggx_visibility_approximate(nl, nv, 0.0) * 4 * nl * nv, 1, 1e-12);
      EXPECT_NEAR(ggx_visibility_approximate(nl, nv, 1.0), ggx_visibility_correlated(nl, nv, 1.0),
                  1e-12 * ggx_visibility_correlated(nl, nv, 1.0));
    }
  }
}

/// G1 is what makes the visible facets' projected area the plane's own: ∫ D G1 ⟨v·h⟩ dω = n·v. Heitz 2014,
/// eq. 13.
TEST(Microfacet, VisibleFacetsCoverWhatIsSeen) {
  for (const double alpha : {0.2, 0.5, 1.0}) {
    for (const double nv : {0.1, 0.5, 0.9}) {
      const double sv = std::sqrt(1 - nv * nv);
      const double area = over_hemisphere([&](double nh, double s2) {
        // The mean over azimuth of ⟨v·h⟩ = ⟨p + q cos φ⟩, in closed form; its bend at p = q costs the
        // quadrature its last digits.
        const double p = nv * nh, q = sv * std::sqrt(s2);
        const double last = p >= q ? kPi : std::acos(-p / q);
        return ggx_distribution_from_sine(s2, alpha) * (p * last + q * std::sin(last)) / kPi;
      });
      EXPECT_NEAR(ggx_g1(nv, alpha) * area, nv, 1e-5) << alpha << " " << nv;
    }
  }
}

TEST(Microfacet, CharliesFitIsContinuousAndFallsWithHeight) {
  for (const double alpha : kAlphas) {
    EXPECT_NEAR(charlie_lambda(0.5 - 1e-9, alpha), charlie_lambda(0.5, alpha), 1e-6);
    for (double c = 0.01; c < 0.99; c += 0.01) {
      EXPECT_GT(charlie_lambda(c, alpha), charlie_lambda(c + 0.01, alpha)) << c;
    }
    EXPECT_TRUE(std::isfinite(charlie_lambda(0.0, alpha)) && std::isfinite(charlie_lambda(1.0, alpha)));
  }
}

/// Snell's law and Fresnel's two amplitudes, in complex numbers.
double fresnel_by_amplitudes(double cosine, std::complex<double> index) {
  const std::complex<double> sine = std::sqrt(1 - cosine * cosine) / index,
                             inner = std::sqrt(1.0 - sine * sine);
  const std::complex<double> s = (cosine - index * inner) / (cosine + index * inner),
                             p = (index * cosine - inner) / (index * cosine + inner);
  return 0.5 * (std::norm(s) + std::norm(p));
}

TEST(Fresnel, IsWhatTheAmplitudesGive) {
  for (const double n : {0.05, 0.5, 0.99, 1.0001, 1.33, 1.5, 5.0, 200.0}) {
    for (double c = 1e-4; c <= 1; c += 0.0101) {
      EXPECT_NEAR(fresnel_dielectric(c, n), fresnel_by_amplitudes(c, n), 1e-12) << n << " " << c;
      for (const double k : {0.0, 1e-6, 0.1, 3.0, 80.0}) {
        EXPECT_NEAR(fresnel_conductor(c, n, k), fresnel_by_amplitudes(c, {n, k}), 2e-11)
            << n << " " << k << " " << c;
      }
    }
    EXPECT_NEAR(fresnel_dielectric(1.0, n), f0_of_eta(n), 1e-14);
    EXPECT_NEAR(fresnel_conductor(1.0, n, 3.0), f0_of_conductor(n, 3.0), 1e-14);
  }
}

TEST(Fresnel, HasItsLimits) {
  EXPECT_EQ(fresnel_dielectric(0.0, 1.5), 1);  // grazing
  EXPECT_EQ(fresnel_conductor(0.0, 0.2, 3.0), 1);
  for (const double c : {0.0, 0.3, 1.0}) {
    EXPECT_EQ(fresnel_dielectric(c, 1.0), 0);  // no boundary
    EXPECT_EQ(fresnel_conductor(c, 1.0, 0.0), 0);
  }
  const double critical = std::sqrt(1 - 0.25);  // sin θ = η = ½
  EXPECT_EQ(fresnel_dielectric(critical - 1e-6, 0.5), 1);
  EXPECT_LT(fresnel_dielectric(critical + 1e-6, 0.5), 1);
  EXPECT_EQ(fresnel_schlick(0.04, 1.0, 1.0), 0.04);
  EXPECT_EQ(fresnel_schlick(0.04, 1.0, 0.0), 1);
}

TEST(Fresnel, VanishesInOnePolarisationAtBrewstersAngle) {
  // tan θ = η, where half of s alone is left: ½ ((η² − 1)/(η² + 1))².
  for (const double eta : {1.1, 1.5, 3.0}) {
    const double c = 1 / std::sqrt(1 + eta * eta), s = (eta * eta - 1) / (eta * eta + 1);
    EXPECT_NEAR(fresnel_dielectric(c, eta), 0.5 * s * s, 1e-15);
  }
}

TEST(Microfacet, FloatsFollowDoubles) {
  for (const double alpha : kAlphas) {
    for (const double c : kCosines) {
      const auto a = static_cast<float>(alpha), x = static_cast<float>(c);
      const auto near = [](double found, double wanted) { EXPECT_NEAR(found, wanted, 1e-4 * wanted); };
      near(ggx_g1(x, a), ggx_g1<double>(x, a));
      near(ggx_visibility_correlated(x, 0.5f, a), ggx_visibility_correlated<double>(x, 0.5, a));
      near(charlie_visibility(x, 0.5f, a), charlie_visibility<double>(x, 0.5, a));
      near(fresnel_dielectric(x, 1.5f), fresnel_dielectric<double>(x, 1.5));
    }
  }
}

}  // namespace
}  // namespace welkin::brdf
