#include "welkin/harmonics/zonal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "welkin/base/error.h"
#include "welkin/harmonics/dering.h"
#include "welkin/harmonics/error_of.h"
#include "welkin/harmonics/extrema.h"
#include "welkin/harmonics/harmonics_cases.h"
#include "welkin/harmonics/project.h"
#include "welkin/map/map_cases.h"
#include "welkin/math/angles.h"
#include "welkin/math/gauss_legendre.h"

namespace welkin::harmonics {
namespace {

using cases::random_direction;
using cases::random_harmonics;

/// Light from one direction, of power 1, over an even one of radiance `even`.
SphericalHarmonics sun(const Vec3d& direction, double even, int degree, int channels = 1) {
  SphericalHarmonics result(degree, channels);
  std::vector<double> functions(static_cast<std::size_t>(result.count()));
  evaluate_functions(degree, direction, functions);
  for (std::size_t i = 0; i < functions.size(); ++i) {
    for (std::size_t c = 0; c < static_cast<std::size_t>(channels); ++c)
      result.values()[i * static_cast<std::size_t>(channels) + c] = functions[i];
  }
  for (int c = 0; c < channels; ++c) result.at(0, 0, c) += even * std::sqrt(4 * kPi);
  return result;
}

/// The least value by many directions.
double least_sampled(const SphericalHarmonics& f, int channel) {
  std::vector<Vec3d> directions;
  for (int i = 0; i < 20000; ++i) {
    const double z = 1 - (2 * i + 1) / 20000.0, angle = i * kPi * (3 - std::sqrt(5.0)),
                 level = std::sqrt(1 - z * z);
    directions.push_back({level * std::cos(angle), level * std::sin(angle), z});
  }
  std::vector<double> values(directions.size() * static_cast<std::size_t>(f.channels()));
  f.evaluate(directions, values);
  double least = 1e300;
  for (std::size_t i = static_cast<std::size_t>(channel); i < values.size();
       i += static_cast<std::size_t>(f.channels()))
    least = std::min(least, values[i]);
  return least;
}

TEST(IrradianceFactors, AreThoseOfTheCosineByQuadrature) {
  const std::vector<double> factors = irradiance_factors(40);
  const QuadratureRule rule = gauss_legendre(64);
  for (int l = 0; l <= 40; ++l) {
    double sum = 0;
    for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
      const double x = 0.5 + 0.5 * rule.nodes[k];
      sum += 2 * kPi * 0.5 * rule.weights[k] * x * std::legendre(static_cast<unsigned>(l), x);
    }
    EXPECT_NEAR(factors[static_cast<std::size_t>(l)], sum, 1e-13) << l;
  }
  const std::vector<double> lambert = lobe_factors(lobe::AnyLobe::make("lambert"), 40);
  for (std::size_t l = 0; l < lambert.size(); ++l) EXPECT_NEAR(lambert[l], factors[l] / kPi, 1e-10);
}

TEST(Windows, FallFromOneAndStaySo) {
  for (const char* name : {"none", "hann", "lanczos"}) {
    const std::vector<double> factors = window_factors(window_from_name(name), 9);
    EXPECT_EQ(factors[0], 1);
    for (std::size_t l = 1; l < factors.size(); ++l) {
      EXPECT_LE(factors[l], factors[l - 1]);
      EXPECT_GT(factors[l], 0);
    }
  }
  EXPECT_NEAR(window_factors(Window::hann, 3)[2], 0.5, 1e-15);
  EXPECT_NEAR(window_factors(Window::lanczos, 3)[2], 2 / kPi, 1e-15);
  EXPECT_THROW(window_from_name("hamming"), Error);
}

TEST(LinearPart, IsTheDirectionAndTheSharpnessOfLight) {
  std::mt19937 random(1);
  const Vec3d direction = random_direction(random);
  const LinearPart alone = linear_part(sun(direction, 0, 1), 0);
  EXPECT_NEAR(alone.ratio, 1, 1e-14);
  EXPECT_LT(angle_between(alone.direction, direction), 1e-12);
  EXPECT_NEAR(alone.mean, 1 / (4 * kPi), 1e-15);
  // Half of the light is even.
  EXPECT_NEAR(linear_part(sun(direction, 1 / (4 * kPi), 1), 0).ratio, 0.5, 1e-14);
  EXPECT_EQ(linear_part(SphericalHarmonics(1, 1), 0).ratio, 0);
  EXPECT_EQ(linear_part(SphericalHarmonics(0, 1), 0).ratio, 0);
}

TEST(ZonalFit, FindsTheAxisOfWhatIsSymmetric) {
  std::mt19937 random(2);
  for (const int degree : {1, 2, 5}) {
    const Vec3d axis = random_direction(random);
    SphericalHarmonics f = sun(axis, 0.1, degree, 2);
    std::vector<double> factors;
    for (int l = 0; l <= degree; ++l) factors.push_back(std::exp(-0.3 * l));
    f = convolved(f, factors);
    const ZonalFit fit = fit_zonal(f, degree);
    EXPECT_LT(angle_between(fit.axis, axis), 1e-7) << degree;
    EXPECT_LT(fit.error, 1e-7);
    // Y_l0 along its pole.
    for (int l = 1; l <= degree; ++l)
      EXPECT_NEAR(fit.coefficients[static_cast<std::size_t>(2 * l)],
                  factors[static_cast<std::size_t>(l)] * std::sqrt((2 * l + 1) / (4 * kPi)), 1e-9);
  }
}

TEST(ZonalFit, IsTheLeastSquaresOfAllAxes) {
  std::mt19937 random(3);
  const SphericalHarmonics f = random_harmonics(4, 3, random);
  const ZonalFit fit = fit_zonal(f, 4);
  double kept = 0;
  for (const double each : fit.coefficients) kept += each * each;
  EXPECT_NEAR(fit.error * fit.error, 1 - kept / (f.norm() * f.norm()), 1e-12);
  for (int i = 0; i < 2000; ++i) {
    // Turned so that an axis is the pole, the coefficients of m = 0 are what a zonal function keeps.
    const Vec3d z = random_direction(random), x = normalize(cross(z, Vec3d{0.3, 0.8, -0.2})), y = cross(z, x);
    const SphericalHarmonics turned = rotated(f, {{{{x.x, x.y, x.z}, {y.x, y.y, y.z}, {z.x, z.y, z.z}}}});
    double other = 0;
    for (int l = 0; l <= 4; ++l) {
      for (int c = 0; c < 3; ++c) other += turned.at(l, 0, c) * turned.at(l, 0, c);
    }
    EXPECT_LE(other, kept * (1 + 1e-12));
  }
}

TEST(Minimum, IsTheLeastOfManyDirections) {
  std::mt19937 random(4);
  for (const int degree : {0, 1, 2, 3, 6, 12}) {
    for (int i = 0; i < (degree <= 2 ? 20 : 3); ++i) {
      const SphericalHarmonics f = random_harmonics(degree, 2, random);
      const Extremum least = minimum_of(f, 1);
      double there[2];
      f.evaluate(least.direction, there);
      EXPECT_NEAR(there[1], least.value, 1e-12 * f.norm());
      EXPECT_NEAR(length(least.direction), 1, 1e-12);
      const double sampled = least_sampled(f, 1);
      EXPECT_LE(least.value, sampled + 1e-12 * f.norm()) << degree;
      EXPECT_GE(least.value, sampled - 1e-2 * f.norm()) << degree;
    }
  }
}

TEST(Minimum, OfSymmetricFunctionsIsExact) {
  SphericalHarmonics f(2, 1);
  f.at(2, 0, 0) = 1;  // least on the whole equator
  EXPECT_NEAR(minimum_of(f, 0).value, -std::sqrt(5 / (16 * kPi)), 1e-14);
  f.at(2, 0, 0) = -1;  // at both poles
  EXPECT_NEAR(minimum_of(f, 0).value, -2 * std::sqrt(5 / (16 * kPi)), 1e-14);
  f.at(2, 0, 0) = 0;
  EXPECT_EQ(minimum_of(f, 0).value, 0);
  f.at(1, 0, 0) = 1;
  EXPECT_NEAR(minimum_of(f, 0).value, -std::sqrt(3 / (4 * kPi)), 1e-14);
  f.at(2, 0, 0) = -1e-3;  // the linear part chooses the pole
  EXPECT_NEAR(minimum_of(f, 0).direction.z, -1, 1e-12);
}

/// RMS change of the irradiance of one channel by factors, over its RMS.
double change_by(const SphericalHarmonics& radiance, const std::vector<double>& factors) {
  const SphericalHarmonics before = convolved(radiance, irradiance_factors(radiance.degree()));
  SphericalHarmonics after = convolved(before, factors);
  after *= -1;
  after += before;
  return after.norm() / before.norm();
}

TEST(Dering, LeavesNothingNegativeAndChangesLessThanAnyWindow) {
  std::mt19937 random(5);
  for (const int degree : {1, 2, 4, 8}) {
    for (const double even : {0.0, 0.01, 0.03}) {
      SphericalHarmonics radiance = sun(random_direction(random), even, degree);
      radiance += convolved(sun(random_direction(random), 0, degree),
                            std::vector<double>(static_cast<std::size_t>(degree) + 1, 0.4));
      const std::vector<double> zonal = irradiance_factors(degree);
      const Deringing found = dering(radiance, zonal);
      const SphericalHarmonics irradiance = convolved(found.harmonics, zonal);
      EXPECT_GE(minimum_of(irradiance, 0).value, 0) << degree;
      EXPECT_GE(least_sampled(irradiance, 0), 0) << degree;
      EXPECT_NEAR(change_by(radiance, found.factors[0]), found.change, 1e-12);
      if (found.before[0].value >= 0) {
        EXPECT_EQ(found.change, 0);
        continue;
      }
      EXPECT_LT(found.before[0].value, 0);
      // Windows of one parameter, widened until nothing is negative: Sloan's Laplacian, Filament's sin⁴,
      // Hann.
      using Family = std::function<double(double l, double t)>;
      const Family families[] = {
          [](double l, double t) { return 1 / (1 + t * t * l * l * (l + 1) * (l + 1)); },
          [](double l, double t) {
            return l * t == 0 ? 1 : l * t >= 1 ? 0 : std::pow(std::sin(kPi * l * t) / (kPi * l * t), 4);
          },
          [](double l, double t) { return l * t >= 1 ? 0 : 0.5 + 0.5 * std::cos(kPi * l * t); }};
      for (const Family& family : families) {
        double low = 0, high = 100;
        std::vector<double> factors(zonal.size());
        for (int step = 0; step < 50; ++step) {
          const double t = (low + high) / 2;
          for (std::size_t l = 0; l < factors.size(); ++l) factors[l] = family(static_cast<double>(l), t);
          (minimum_of(convolved(convolved(radiance, zonal), factors), 0).value < 0 ? low : high) = t;
        }
        for (std::size_t l = 0; l < factors.size(); ++l) factors[l] = family(static_cast<double>(l), high);
        EXPECT_LE(found.change, change_by(radiance, factors) * (1 + 1e-5)) << degree;
      }
    }
  }
}

TEST(Dering, IsTheLeastChangeOfAllFactors) {
  // Of degree 2, by trying all pairs of factors.
  const SphericalHarmonics radiance = sun({0.6, 0, 0.8}, 0.005, 2);
  const std::vector<double> zonal = irradiance_factors(2);
  const Deringing found = dering(radiance, zonal);
  ASSERT_GT(found.change, 0);
  double least = 1;
  for (int i = 0; i <= 200; ++i) {
    for (int k = 0; k <= 200; ++k) {
      const std::vector<double> factors{1, 1 - 0.5 * i / 200, 1 - 0.5 * k / 200};
      const double change = change_by(radiance, factors);
      if (change < least && minimum_of(convolved(convolved(radiance, zonal), factors), 0).value >= 0)
        least = change;
    }
  }
  EXPECT_LE(found.change, least);
  EXPECT_GE(found.change, 0.97 * least);  // the step of the trial
}

TEST(Dering, TreatsChannelsAloneOrTogether) {
  SphericalHarmonics radiance = sun({0, 1, 0}, 0, 2, 3);
  for (int i = 0; i < radiance.count(); ++i) radiance.values()[static_cast<std::size_t>(3 * i + 1)] *= 0.5;
  radiance.at(0, 0, 2) += 5;
  const std::vector<double> zonal = irradiance_factors(2);
  const Deringing each = dering(radiance, zonal),
                  together = dering(radiance, zonal, DeringChannels::together);
  EXPECT_EQ(each.factors[2], (std::vector<double>{1, 1, 1}));
  EXPECT_EQ(together.factors[2], together.factors[0]);
  for (int c = 0; c < 3; ++c) {
    EXPECT_GE(each.after[static_cast<std::size_t>(c)].value, 0);
    EXPECT_GE(together.after[static_cast<std::size_t>(c)].value, 0);
  }
  EXPECT_LE(each.change, together.change);
}

TEST(Dering, LeavesBlackBlackAndRefusesWhatHasNoLight) {
  EXPECT_EQ(dering(SphericalHarmonics(2, 3), irradiance_factors(2)).change, 0);
  SphericalHarmonics dark = sun({0, 0, 1}, -1, 2);
  EXPECT_THROW(dering(dark, irradiance_factors(2)), Error);
}

TEST(ErrorOf, IsThatOfTheSphereByQuadrature) {
  std::mt19937 random(6);
  const SphericalHarmonics exact = random_harmonics(12, 2, random), few = with_degree(exact, 2);
  const std::vector<double> zonal = irradiance_factors(12);
  const HarmonicsError error = error_of(few, exact, zonal);
  double squares = 0, difference = 0;
  const SphericalHarmonics a = convolved(few, zonal), b = convolved(exact, zonal);
  double x[2], y[2];
  for (int i = 0; i < 40000; ++i) {
    const Vec3d d = random_direction(random);
    a.evaluate(d, x);
    b.evaluate(d, y);
    for (int c = 0; c < 2; ++c) {
      squares += y[c] * y[c];
      difference += (x[c] - y[c]) * (x[c] - y[c]);
    }
  }
  EXPECT_NEAR(error.relative_rmse, std::sqrt(difference / squares), 0.02 * error.relative_rmse);
  EXPECT_EQ(error.minima[1].value, minimum_of(a, 1).value);
  EXPECT_THROW(error_of(few, SphericalHarmonics(12, 1), zonal), Error);
}

// Of a map with waves of many degrees: above what degrees 13 … 60 are, and not much above where nearly all of
// them lie close to the last.
TEST(MostBeyond, BoundsWhatHigherDegreesAdd) {
  const Map map = welkin::cases::rendered("latlong", 128, welkin::cases::waves(6, 12));
  const SphericalHarmonics exact = project(map, 60);
  for (const int degree : {4, 8, 12}) {
    const SphericalHarmonics few = with_degree(exact, degree);
    const std::vector<double> zonal = irradiance_factors(60);
    const double beyond = error_of(few, exact, zonal).relative_rmse,
                 most = most_beyond(map, few, irradiance_factors(degree));
    EXPECT_GT(most, beyond) << degree;
    EXPECT_LT(most, 30 * beyond) << degree;
  }
  EXPECT_LT(most_beyond(map, exact, irradiance_factors(60)), 1e-4);
  const Map black(map.parameterization, 16, 8, 3);
  EXPECT_EQ(most_beyond(black, project(black, 2), irradiance_factors(2)), 0);
  EXPECT_THROW(most_beyond(map, exact, irradiance_factors(2)), Error);
  SphericalHarmonics named = exact;
  named.channel_names[0] = "depth";
  EXPECT_THROW(most_beyond(map, named, irradiance_factors(60)), Error);
}

TEST(ReferenceOf, IsNearTheExactOneWhereItTakesACoarserLevel) {
  const Map map = welkin::cases::rendered("cube", 128, welkin::cases::waves(6, 12));
  const SphericalHarmonics known = project(map, 2), reference = reference_of(map, known, 60);
  EXPECT_EQ(cases::relative_error(with_degree(reference, 2), known), 0);
  const std::vector<double> zonal = irradiance_factors(60);
  const double fast = error_of(known, reference, zonal).relative_rmse,
               exact = error_of(known, project(map, 60), zonal).relative_rmse;
  EXPECT_NEAR(fast, exact, 0.01 * exact);
}

}  // namespace
}  // namespace welkin::harmonics
