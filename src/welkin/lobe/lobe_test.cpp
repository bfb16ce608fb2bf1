#include "welkin/lobe/lobe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "welkin/base/error.h"
#include "welkin/lobe/angle.h"
#include "welkin/lobe/kernels.h"
#include "welkin/lobe/lobe_cases.h"
#include "welkin/lobe/zonal.h"

namespace welkin::lobe {
namespace {

TEST(Lobe, EveryNameMakesALobeOfThatName) {
  for (const std::string& name : lobe_names()) {
    const AnyLobe lobe = AnyLobe::make(name);
    EXPECT_EQ(lobe.name(), name);
    EXPECT_EQ(lobe.spec(), name);
    EXPECT_FALSE(lobe.description().empty());
    EXPECT_FALSE(lobe.source().empty());
  }
}

TEST(Lobe, ReadsItsOwnSpecBack) {
  for (const char* spec : {"ggx,roughness=0.125", "phong,roughness=0.3", "phong,roughness=0", "vmf,kappa=7",
                           "blinn,exponent=37.5", "charlie,roughness=0.2"}) {
    const AnyLobe lobe = AnyLobe::make(spec), again = AnyLobe::make(lobe.spec());
    EXPECT_EQ(lobe.spec(), again.spec());
    if (lobe.is_mirror()) continue;
    for (const double s : cases::s_values()) EXPECT_EQ(lobe.weight(s), again.weight(s)) << spec;
  }
}

std::string message_of(const std::string& spec) {
  try {
    AnyLobe::make(spec);
  } catch (const Error& error) {
    return error.what();
  }
  return "made";
}

TEST(Lobe, RefusesBadSpecsAndSuggestsTheNearest) {
  EXPECT_NE(message_of("gxg").find("did you mean 'ggx'"), std::string::npos);
  EXPECT_NE(message_of("lambert,roughness=1").find("takes no parameters"), std::string::npos);
  EXPECT_NE(message_of("ggx,rougness=0.5").find("did you mean 'roughness'"), std::string::npos);
  EXPECT_NE(message_of("ggx,roughness").find("write roughness=NUMBER"), std::string::npos);
  for (const char* spec : {"ggx,roughness=-0.1", "ggx,roughness=1.1", "ggx,roughness=nan",
                           "ggx,roughness=", "phong,exponent=-1", "vmf,kappa=inf", "charlie,roughness=0"}) {
    EXPECT_NE(message_of(spec).find("is not a number in"), std::string::npos) << spec;
  }
}

TEST(Lobe, HasARoughnessWhereItSaysSo) {
  for (const AnyLobe& lobe : cases::all_lobes()) {
    if (!lobe.has_roughness()) {
      EXPECT_THROW(lobe.with_roughness(0.5), Error) << lobe.spec();
      continue;
    }
    EXPECT_FALSE(lobe.with_roughness(0.5).is_mirror()) << lobe.spec();
    EXPECT_THROW(lobe.with_roughness(1.5), Error) << lobe.spec();
    EXPECT_THROW(lobe.with_roughness(-0.5), Error) << lobe.spec();
    if (lobe.name() == "charlie") continue;
    EXPECT_TRUE(lobe.with_roughness(0).is_mirror()) << lobe.spec();
  }
  EXPECT_EQ(AnyLobe::make("phong").with_roughness(0.01).spec(), AnyLobe::make("phong,exponent=100").spec());
}

TEST(Lobe, WeightsAreFiniteAndNeverNegative) {
  for (const AnyLobe& lobe : cases::all_lobes()) {
    for (const double s : cases::s_values()) {
      const double weight = lobe.weight(s);
      EXPECT_TRUE(std::isfinite(weight) && weight >= 0) << lobe.spec() << " at " << s;
    }
  }
}

/// The definitions in cos θ, α and n·h, where those keep enough digits: relative error 1e-6.
TEST(Lobe, FollowsTheFormulasOfItsSource) {
  const double roughness = 0.4, alpha = roughness * roughness, a = alpha * alpha;
  const AnyLobe ggx = AnyLobe::make("ggx,roughness=0.4"), blinn = AnyLobe::make("blinn,roughness=0.4"),
                charlie = AnyLobe::make("charlie,roughness=0.4"), phong = AnyLobe::make("phong,exponent=12"),
                vmf = AnyLobe::make("vmf,kappa=3"), lambert = AnyLobe::make("lambert");
  const auto distribution = [&](double nh) { return a / std::pow(nh * nh * (a - 1) + 1, 2); };
  // The formulas have other constants in front: compared against their values at one angle.
  const double t0 = std::cos(0.3), h0 = std::cos(0.15), s0 = s_of_angle(0.3);
  for (double angle = 0.05; angle < 1.55; angle += 0.05) {
    const double t = std::cos(angle), nh = std::cos(angle / 2), sh = std::sin(angle / 2);
    const double s = s_of_angle(angle);
    const auto expect = [&](const AnyLobe& lobe, double value, double value0) {
      EXPECT_NEAR(lobe.weight(s) / lobe.weight(s0) / (value / value0), 1, 1e-6) << lobe.spec() << angle;
    };
    expect(ggx, distribution(nh) * t, distribution(h0) * t0);
    const double exponent = 2 / a - 2;
    expect(blinn, std::pow(nh, exponent) * t, std::pow(h0, exponent) * t0);
    expect(charlie, std::pow(sh, 1 / alpha) * t, std::pow(std::sin(0.15), 1 / alpha) * t0);
    expect(phong, std::pow(t, 12), std::pow(t0, 12));
    expect(vmf, std::exp(3 * t), std::exp(3 * t0));
    expect(lambert, t, t0);
  }
  for (const char* spec : {"ggx", "blinn", "charlie", "phong", "lambert"}) {
    EXPECT_EQ(AnyLobe::make(spec).weight(1.01), 0) << spec;
  }
}

TEST(Lobe, IntegralsMatchTheClosedForms) {
  const auto expect = [](const std::string& spec, double integral) {
    EXPECT_NEAR(AnyLobe::make(spec).integral() / integral, 1, 1e-11) << spec;
  };
  expect("lambert", kPi);
  for (const double n : {0.0, 0.3, 1.0, 2.5, 10.0, 1e3, 1e7}) {
    expect("phong,exponent=" + std::to_string(n), 2 * kPi / (n + 1));
  }
  for (const double kappa : {0.5, 1.0, 20.0, 1e4, 1e8}) {
    expect("vmf,kappa=" + std::to_string(kappa), -2 * kPi * std::expm1(-2 * kappa) / kappa);
  }
  expect("vmf,kappa=0", 4 * kPi);
  for (const double roughness : {0.9, 0.5, 0.1, 0.015625, 0.002}) {
    // ∫ (1 − s)/(1 + k s)² ds = (k − ln(1 + k))/k²
    const double a = std::pow(roughness, 4), k = (1 - a) / (2 * a);
    expect("ggx,roughness=" + std::to_string(roughness), 2 * kPi * (k - std::log1p(k)) / (k * k));
  }
  expect("ggx,roughness=1", kPi);
  for (const double roughness : {1.0, 0.5, 0.3, 0.1, 0.03}) {
    // ∫ s^p (1 − s) ds = 1/((p + 1)(p + 2))
    const double p = 0.5 / (roughness * roughness);
    expect("charlie,roughness=" + std::to_string(roughness), 2 * kPi / ((p + 1) * (p + 2)));
  }
}

/// Half of the largest weight is reached at the width, within a factor of two of either; charlie's width is
/// its ring's.
TEST(Lobe, FallsToAboutHalfAtItsWidth) {
  for (const AnyLobe& lobe : cases::all_lobes()) {
    const std::string spec = lobe.spec();
    const bool flat = spec == "phong,exponent=0" || spec == "vmf,kappa=0" || spec == "table,even";
    if (flat || lobe.name() == "charlie") continue;
    const double part = lobe.weight(s_of_angle(lobe.width())) / cases::largest_weight(lobe);
    EXPECT_GT(part, 0.24) << lobe.spec();
    EXPECT_LT(part, 1) << lobe.spec();
    EXPECT_GT(lobe.width(), 0) << lobe.spec();
  }
}

/// The contract of AnyLobe::weights, by both instruction sets.
TEST(Lobe, KernelsAgreeWithDoubles) {
  std::vector<float> s;
  for (const double value : cases::s_values()) s.push_back(static_cast<float>(value));
  for (float small = 1; small > 1e-18f; small /= 3) s.push_back(small);
  const std::size_t count = s.size();
  s.resize((count + kLanes - 1) / kLanes * kLanes, 0.5f);
  std::vector<float> weights(s.size());
  const std::vector<AnyLobe> lobes = cases::all_lobes();
  for (const AnyLobe& lobe : lobes) {
    std::vector<Weights> kernels{lobe.weights()};
    for (std::size_t i = 0; i < lobe_names().size(); ++i) {
      if (lobe_names()[i] == lobe.name()) kernels.push_back(weights_baseline(i));
    }
    EXPECT_EQ(kernels.size(), lobe.name() == "table" ? 1u : 2u);
    const double largest = cases::largest_weight(lobe);
    const double absolute = lobe.name() == "table" ? 1e-6 * largest : 1e-25 * largest;
    for (const Weights kernel : kernels) {
      kernel(lobe.self(), s.data(), weights.data(), count);
      for (std::size_t i = 0; i < count; ++i) {
        const double exact = lobe.weight(s[i]);
        const double relative = exact > 1e-20 * largest ? 1e-5 * exact : 0;
        EXPECT_NEAR(weights[i], exact, relative + absolute) << lobe.spec() << " at s = " << s[i];
      }
    }
  }
}

}  // namespace
}  // namespace welkin::lobe
