#include "welkin/harmonics/harmonics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "welkin/base/error.h"
#include "welkin/harmonics/harmonics_cases.h"
#include "welkin/map/map.h"
#include "welkin/math/gauss_legendre.h"

namespace welkin::harmonics {
namespace {

using cases::random_direction;
using cases::random_harmonics;

/// Directions and weights that integrate products of two functions of that degree exactly.
struct Grid {
  explicit Grid(int degree) {
    const QuadratureRule rule = gauss_legendre(degree + 2);
    const int columns = 2 * degree + 2;
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      const double z = rule.nodes[i], level = std::sqrt(1 - z * z);
      for (int k = 0; k < columns; ++k) {
        const double angle = 2 * kPi * (k + 0.3) / columns;
        directions.push_back({level * std::cos(angle), level * std::sin(angle), z});
        weights.push_back(2 * kPi * rule.weights[i] / columns);
      }
    }
  }
  std::vector<Vec3d> directions;
  std::vector<double> weights;
};

TEST(HarmonicFunctions, AreOrthonormalOverTheSphere) {
  const int degree = 24;
  const Grid grid(degree);
  const std::size_t count = static_cast<std::size_t>(count_of(degree));
  std::vector<double> values(count), products(count * count);
  for (std::size_t i = 0; i < grid.directions.size(); ++i) {
    evaluate_functions(degree, grid.directions[i], values);
    for (std::size_t a = 0; a < count; ++a) {
      for (std::size_t b = 0; b < count; ++b)
        products[a * count + b] += grid.weights[i] * values[a] * values[b];
    }
  }
  for (std::size_t a = 0; a < count; ++a) {
    for (std::size_t b = 0; b < count; ++b)
      ASSERT_NEAR(products[a * count + b], a == b ? 1 : 0, 1e-12) << a << " " << b;
  }
}

TEST(HarmonicFunctions, OfDegreesOneAndTwoAreThePolynomialsOfTheConvention) {
  std::mt19937 random(1);
  for (int i = 0; i < 20; ++i) {
    const auto [x, y, z] = random_direction(random);
    double v[9];
    evaluate_functions(2, {x, y, z}, v);
    const double one = std::sqrt(3 / (4 * kPi)), two = std::sqrt(15 / (4 * kPi));
    const double expected[9] = {std::sqrt(1 / (4 * kPi)),
                                one * y,
                                one * z,
                                one * x,
                                two * x * y,
                                two * y * z,
                                std::sqrt(5 / (16 * kPi)) * (3 * z * z - 1),
                                two * x * z,
                                two / 2 * (x * x - y * y)};
    for (int k = 0; k < 9; ++k) EXPECT_NEAR(v[k], expected[k], 1e-15) << k;
  }
}

TEST(HarmonicFunctions, AddUpToTheSameSquareEverywhere) {
  // Unsöld's theorem: Σ_m Y_lm² = (2l + 1)/4π, also at the poles and beside them.
  std::mt19937 random(2);
  std::vector<double> values(static_cast<std::size_t>(count_of(kMaxDegree)));
  std::vector<Vec3d> directions{{0, 0, 1}, {0, 0, -1}, {1e-9, 0, 1}, {1, 0, 0}};
  for (int i = 0; i < 4; ++i) directions.push_back(random_direction(random));
  for (const Vec3d& d : directions) {
    evaluate_functions(kMaxDegree, d, values);
    for (const int l : {0, 1, 7, 64, kMaxDegree}) {
      double sum = 0;
      for (int m = -l; m <= l; ++m)
        sum += values[static_cast<std::size_t>(index_of(l, m))] *
               values[static_cast<std::size_t>(index_of(l, m))];
      EXPECT_NEAR(sum * 4 * kPi / (2 * l + 1), 1, 1e-11) << l;
    }
  }
}

TEST(SphericalHarmonics, EvaluateTheSameOneByOneAndTogether) {
  std::mt19937 random(3);
  const SphericalHarmonics f = random_harmonics(11, 2, random);
  std::vector<Vec3d> directions;
  for (int i = 0; i < 150; ++i) directions.push_back(random_direction(random));
  std::vector<double> together(300), one(2);
  f.evaluate(directions, together);
  for (std::size_t i = 0; i < directions.size(); ++i) {
    f.evaluate(directions[i], one);
    EXPECT_NEAR(together[2 * i], one[0], 1e-12);
    EXPECT_NEAR(together[2 * i + 1], one[1], 1e-12);
  }
}

TEST(SphericalHarmonics, TurnedAreTheFunctionAlongDirectionsTurnedBack) {
  std::mt19937 random(4);
  const Matrix3 mirror{{{{1, 0, 0}, {0, 1, 0}, {0, 0, -1}}}};
  const Matrix3 swap{{{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}}};
  const Matrix3 turn = rotation_from_yaw_pitch_roll(31, -77, 123);
  for (const int degree : {0, 1, 2, 3, 9, 64}) {
    const SphericalHarmonics f = random_harmonics(degree, 2, random);
    // What a value can be at most.
    const double bound = f.norm() * (degree + 1) / std::sqrt(4 * kPi);
    for (const Matrix3& rotation :
         {turn, turn * mirror, mirror, swap, rotation_from_yaw_pitch_roll(0, 90, 0)}) {
      const SphericalHarmonics g = rotated(f, rotation);
      EXPECT_NEAR(g.norm(), f.norm(), 1e-12 * f.norm());
      EXPECT_LT(cases::relative_error(rotated(g, transpose(rotation)), f), 2e-12);
      double expected[2], found[2];
      for (int i = 0; i < 20; ++i) {
        const Vec3d d = random_direction(random);
        f.evaluate(d, expected);
        g.evaluate(rotation * d, found);
        for (int c = 0; c < 2; ++c) EXPECT_NEAR(found[c], expected[c], 1e-12 * bound) << degree;
      }
    }
  }
}

TEST(SphericalHarmonics, TurnByEachCoefficientExactly) {
  // The reference: the turned function's coefficients by quadrature.
  std::mt19937 random(5);
  const int degree = 16;
  const SphericalHarmonics f = random_harmonics(degree, 1, random);
  const Matrix3 rotation = rotation_from_yaw_pitch_roll(200, 13, -40);
  const Grid grid(degree);
  SphericalHarmonics expected(degree, 1);
  std::vector<double> functions(static_cast<std::size_t>(f.count()));
  for (std::size_t i = 0; i < grid.directions.size(); ++i) {
    double value = 0;
    f.evaluate(transpose(rotation) * grid.directions[i], {&value, 1});
    evaluate_functions(degree, grid.directions[i], functions);
    for (std::size_t k = 0; k < functions.size(); ++k)
      expected.values()[k] += grid.weights[i] * value * functions[k];
  }
  const SphericalHarmonics g = rotated(f, rotation);
  for (std::size_t k = 0; k < functions.size(); ++k)
    EXPECT_NEAR(g.values()[k], expected.values()[k], 1e-12 * f.norm());
}

TEST(SphericalHarmonics, TurnUpToTheLargestDegree) {
  std::mt19937 random(7);
  const SphericalHarmonics f = random_harmonics(kMaxDegree, 1, random);
  const Matrix3 swap{{{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}}};
  EXPECT_LT(cases::relative_error(rotated(rotated(f, swap), transpose(swap)), f), 2e-9);
}

TEST(SphericalHarmonics, AddWithTheLargerDegree) {
  std::mt19937 random(6);
  const SphericalHarmonics small = random_harmonics(2, 3, random), large = random_harmonics(5, 3, random);
  SphericalHarmonics sum = small;
  sum += large;
  EXPECT_EQ(sum.degree(), 5);
  EXPECT_DOUBLE_EQ(sum.at(1, -1, 2), small.at(1, -1, 2) + large.at(1, -1, 2));
  EXPECT_DOUBLE_EQ(sum.at(4, 3, 0), large.at(4, 3, 0));
  sum *= -2;
  EXPECT_DOUBLE_EQ(sum.at(4, 3, 0), -2 * large.at(4, 3, 0));
  EXPECT_THROW(sum += SphericalHarmonics(1, 2), Error);
}

TEST(SphericalHarmonics, RefuseWhatTheyCannotBe) {
  EXPECT_THROW(SphericalHarmonics(-1, 3), Error);
  EXPECT_THROW(SphericalHarmonics(kMaxDegree + 1, 3), Error);
  EXPECT_THROW(SphericalHarmonics(2, 0), Error);
  EXPECT_THROW(SphericalHarmonics(2, kMaxChannels + 1), Error);
  Matrix3 skewed;
  skewed.rows[0][1] = 0.2;
  EXPECT_THROW(rotated(SphericalHarmonics(2, 3), skewed), Error);
}

}  // namespace
}  // namespace welkin::harmonics
