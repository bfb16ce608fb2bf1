#include "welkin/prefilter/widen.h"

#include <gtest/gtest.h>

#include <cmath>

#include "welkin/brdf/view_lobe.h"
#include "welkin/lobe/lobe_cases.h"
#include "welkin/lobe/zonal.h"
#include "welkin/math/scalar.h"

namespace welkin::prefilter {
namespace {

using lobe::AnyLobe;

std::vector<AnyLobe> lobes() {
  std::vector<AnyLobe> list;
  for (const AnyLobe& each : lobe::cases::all_lobes()) {
    if (!each.is_mirror()) list.push_back(each);
  }
  return list;
}

/// λ at the degree π/texel is at most e^−5⁄4 afterwards, and lobes for which it was so before stay.
TEST(Widen, WideLobesStayAndNarrowOnesReachTheTexel) {
  int wide = 0, narrow = 0;
  for (const AnyLobe& lobe : lobes()) {
    for (const double texel : {1.0, 0.1, 0.02}) {
      const std::size_t finest = static_cast<std::size_t>(kPi / texel);
      const double before = lobe::zonal_coefficients(lobe, static_cast<int>(finest)).back();
      const WidenedLobe widened = widen(lobe, texel, 1e-6);
      if (std::fabs(before) <= std::exp(-1.25)) {
        ++wide;
        EXPECT_EQ(widened.sigma, 0) << lobe.spec();
        EXPECT_EQ(widened.lobe.spec(), lobe.spec());
      } else {
        ++narrow;
        EXPECT_GT(widened.sigma, 0) << lobe.spec();
        // The table's own coefficient: what the level is filtered with. Negative weights, of series cut off,
        // become 0.
        const double after = lobe::zonal_coefficients(widened.lobe, static_cast<int>(finest)).back();
        EXPECT_NEAR(std::fabs(after), std::exp(-1.25), 2e-3) << lobe.spec() << ' ' << texel;
        EXPECT_NEAR(std::fabs(widened.zonal[finest]), std::exp(-1.25), 1e-9) << lobe.spec() << ' ' << texel;
      }
    }
  }
  EXPECT_GT(wide, 10);
  EXPECT_GT(narrow, 10);
}

/// The coefficients and the lobe that come together are of the same function.
TEST(Widen, TheTableHasTheCoefficients) {
  for (const AnyLobe& lobe : lobes()) {
    for (const double texel : {0.3, 0.02}) {
      const WidenedLobe widened = widen(lobe, texel, 1e-5);
      const std::vector<double> zonal =
          lobe::zonal_coefficients(widened.lobe, static_cast<int>(widened.zonal.size()) - 1);
      EXPECT_NEAR(widened.zonal[0], 1, 1e-9);
      EXPECT_GT(widened.lobe.integral(), 0);
      double worst = 0;
      for (std::size_t l = 0; l < zonal.size(); ++l)
        worst = std::max(worst, std::fabs(zonal[l] - widened.zonal[l]));
      EXPECT_LT(worst, 1e-4) << lobe.spec() << ' ' << texel;
    }
  }
}

/// A lobe much narrower than the texel becomes the Gaussian of σ = texel/2: e^(−θ²/2σ²) as far as angles
/// are small, here 0.01.
TEST(Widen, NeedlesBecomeGaussians) {
  constexpr double kTexel = 0.02;
  for (const char* spec : {"ggx,roughness=0.001", "phong,exponent=1e7", "vmf,kappa=1e8"}) {
    const WidenedLobe widened = widen(AnyLobe::make(spec), kTexel, 1e-4);
    EXPECT_NEAR(widened.sigma, kTexel / 2, 2e-2 * kTexel) << spec;
    const double top = widened.lobe.weight(0);
    for (const double sigmas : {0.25, 0.5, 1.0, 2.0, 3.0}) {
      const double half_sine = std::sin(sigmas * widened.sigma / 2);
      EXPECT_NEAR(widened.lobe.weight(2 * half_sine * half_sine) / top, std::exp(-0.5 * sigmas * sigmas),
                  1e-2)
          << spec << ' ' << sigmas;
    }
  }
}

/// As far as the tolerance says, in the mean square: by its definition.
TEST(Widen, DegreesAreAsManyAsTheToleranceAsksFor) {
  for (const AnyLobe& lobe : lobes()) {
    const std::vector<double> zonal = lobe::zonal_coefficients(lobe, 400);
    int before = 1 << 20;
    for (const double tolerance : {1e-6, 1e-4, 1e-2, 0.1}) {
      const int degree = degree_of(zonal, tolerance);
      EXPECT_TRUE(degree >= 1 && degree <= before) << lobe.spec();
      before = degree;
      double all = 0, rest = 0;
      for (std::size_t l = 0; l < zonal.size(); ++l) {
        const double power = (2 * static_cast<double>(l) + 1) * zonal[l] * zonal[l];
        all += power;
        if (l > static_cast<std::size_t>(degree)) rest += power;
      }
      EXPECT_LE(rest, tolerance * tolerance * all) << lobe.spec();
    }
  }
}

/// Averages about the reflected direction have cusps far from it, where circles touch the horizon: they are
/// taken away too, so that what is left has as few degrees as was asked for, 96 on coarse texels.
TEST(Widen, CuspsFarFromTheAxisAreTakenAway) {
  for (const double cosine : {0.01, 0.05, 0.2}) {
    for (const double roughness : {0.4, 0.5, 0.75}) {
      const AnyLobe lobe = brdf::average_lobe(brdf::AnyBrdf::make("ggx").with_roughness(roughness), cosine,
                                              brdf::LobeAxis::reflected)
                               .lobe;
      const WidenedLobe few = widen(without_finer_than(lobe, 0.1, 2e-4), 0.1, 2e-4);
      EXPECT_LE(few.degree(), 100) << roughness << " at " << cosine;
      EXPECT_EQ(few.sigma, 0);
    }
  }
}

}  // namespace
}  // namespace welkin::prefilter
