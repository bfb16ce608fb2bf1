#include "welkin/prefilter/legendre.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "welkin/prefilter/kernels.h"

namespace welkin::prefilter {
namespace {

std::vector<const Kernels*> all_tables() {
  std::vector<const Kernels*> list{&kernels_baseline()};
#ifdef WELKIN_HAS_AVX2
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) list.push_back(&kernels_avx2());
#endif
  return list;
}

double colatitude(int row, int rows) {
  return (row + 0.5) * std::numbers::pi / rows;
}

/// P̄ₗᵐ(cos θ); the standard library's has the sign (−1)ᵐ.
double legendre(int l, int m, double theta) {
  const double value = std::sph_legendre(static_cast<unsigned>(l), static_cast<unsigned>(m), theta);
  return m % 2 == 0 ? value : -value;
}

/// Rows of the harmonic of degree l and order m, [pack][parity][2][8]; `coefficient` in part 0.
std::vector<float> synthesised(const Kernels& table, const Latitudes& latitudes, const Recurrence& r,
                               int degree, int l) {
  std::vector<float> coefficients(static_cast<std::size_t>(degree - r.m + 1) * 2);
  const std::size_t i = static_cast<std::size_t>(l - r.m);
  coefficients[2 * i] = static_cast<float>(r.scale[i]);
  std::vector<float> rows(static_cast<std::size_t>(latitudes.packs) * 32, 7.0f);
  table.synthesise[0](latitudes, r, degree, coefficients.data(), rows.data());
  return rows;
}

/// Fejér's first rule for ∫ f(x) dx at the rows' x = cos θ, exact below degree `rows` (J. Waldvogel, "Fast
/// construction of the Fejér and Clenshaw–Curtis quadrature rules", 2006).
double fejer_weight(int row, int rows) {
  double sum = 1;
  for (int k = 1; k <= rows / 2; ++k) sum -= 2 * std::cos(2 * k * colatitude(row, rows)) / (4.0 * k * k - 1);
  return sum * 2 / rows;
}

/// The recurrence runs in float32 once values count. Its rounding grows with the degree; and cos²θ, and with
/// it θ² near a pole, is off by up to 3e-8, where the functions are Bessel's of lθ, whose slope in θ² is
/// l²/4.
TEST(Legendre, SynthesisGivesTheFunctions) {
  struct Case {
    int rows, degree;
    std::vector<int> orders;
  };
  const Case cases[] = {{18, 16, {0, 1, 2, 7, 15, 16}},
                        {200, 180, {0, 1, 5, 60, 179, 180}},
                        {1104, 1000, {0, 1, 3, 100, 399, 400, 999}}};
  for (const Kernels* table : all_tables()) {
    for (const Case& c : cases) {
      const Latitudes latitudes(c.rows, c.degree);
      for (const int m : c.orders) {
        const Recurrence r(m, c.degree);
        for (int l = m; l <= c.degree; l += 1 + (l - m) / 2 + (c.degree - l) / 3) {
          const std::vector<float> rows = synthesised(*table, latitudes, r, c.degree, l);
          double largest = 0, error = 0;
          for (int i = 0; i < latitudes.count; ++i) {
            const double expected = legendre(l, m, colatitude(i, c.rows));
            const auto at = [&](int parity, int part) {
              return static_cast<double>(
                  rows[static_cast<std::size_t>((i / 8 * 2 + parity) * 16 + part * 8 + i % 8)]);
            };
            largest = std::max(largest, std::fabs(expected));
            const int parity = (l - m) % 2;
            error = std::max(error, std::fabs(at(parity, 0) - expected));
            EXPECT_EQ(at(1 - parity, 0), 0);
            EXPECT_EQ(at(parity, 1), 0);
          }
          EXPECT_LT(error, (2e-7 * (l + 3) + 7.5e-9 * l * l) * largest) << "degree " << l << " order " << m;
        }
      }
    }
  }
}

/// What is left out near the poles is negligible. Measured: 1.1e-6 at degree 1000, order 53.
TEST(Legendre, NothingIsLeftOutBeyondTheLastOrder) {
  for (const int degree : {8, 60, 240, 700}) {
    const int rows = static_cast<int>(1.44 * degree) / 2 * 2 + 8;
    const Latitudes latitudes(rows, degree);
    for (int pack = 0; pack < latitudes.packs; ++pack) {
      const int m = latitudes.last_order[static_cast<std::size_t>(pack)] + 1;
      const double theta = colatitude(std::min(pack * 8 + 7, latitudes.count - 1), rows);
      for (int l = m; l <= degree; l += 1 + (degree - l) / 8)
        EXPECT_LT(std::fabs(legendre(l, m, theta)), 2e-6) << degree << ' ' << l << ' ' << m;
    }
  }
}

/// Analysis of a harmonic's rows with exact weights gives its coefficient back, and none of the others.
/// Rounding: as above, less near the poles, where weights are small.
TEST(Legendre, AnalysisFindsWhatSynthesisMade) {
  for (const Kernels* table : all_tables()) {
    for (const int degree : {5, 30, 121}) {
      const int rows = 2 * degree + 2;  // a product of two has degree 2·degree
      const Latitudes latitudes(rows, degree);
      for (const int m : {0, 1, 4, degree / 2, degree}) {
        if (m > degree) continue;
        const Recurrence r(m, degree);
        for (const int l : {m, std::min(m + 1, degree), (m + degree) / 2, degree}) {
          std::vector<float> data = synthesised(*table, latitudes, r, degree, l);
          for (int i = 0; i < latitudes.packs * 8; ++i) {
            // North plus south, or less: twice the north.
            const double weight = i < latitudes.count ? 4 * std::numbers::pi * fejer_weight(i, rows) : 0;
            for (int k = 0; k < 4; ++k)
              data[static_cast<std::size_t>(i / 8 * 32 + k * 8 + i % 8)] *= static_cast<float>(weight);
          }
          std::vector<float> work(static_cast<std::size_t>(degree + 2) * 16), out(work.size() / 8);
          table->analyse[0](latitudes, r, degree, data.data(), work.data(), out.data());
          for (int found = m; found <= degree; ++found) {
            const std::size_t index = static_cast<std::size_t>(found - m) * 2;
            EXPECT_NEAR(static_cast<double>(out[index]), found == l ? 1 : 0, 4e-7 * (degree + 3))
                << degree << ' ' << m << ' ' << l << ' ' << found;
            EXPECT_EQ(out[index + 1], 0.0f);
          }
        }
      }
    }
  }
}

/// One, two and three channels, and both instruction sets, make the same sums: they differ by fused rounding
/// alone.
TEST(Legendre, ChannelsAndInstructionSetsAgree) {
  constexpr int kDegree = 90, kRows = 140;
  const Latitudes latitudes(kRows, kDegree);
  std::mt19937 random(4);
  std::uniform_real_distribution<float> value(-1, 1);
  for (const int m : {0, 3, 50, 90}) {
    const Recurrence r(m, kDegree);
    const int degrees = kDegree - m + 1;
    std::vector<float> coefficients(static_cast<std::size_t>(degrees) * 6);
    for (std::size_t i = 0; i < coefficients.size(); ++i)
      coefficients[i] = value(random) * static_cast<float>(r.scale[i / 6]);
    std::vector<float> rows(static_cast<std::size_t>(latitudes.packs) * 96);
    kernels_baseline().synthesise[2](latitudes, r, kDegree, coefficients.data(), rows.data());
    std::vector<float> work(static_cast<std::size_t>(degrees + 1) * 48), sums(coefficients.size());
    kernels_baseline().analyse[2](latitudes, r, kDegree, rows.data(), work.data(), sums.data());
    double largest = 0, maximum = 0;
    for (const float each : rows) largest = std::max(largest, std::fabs(static_cast<double>(each)));
    for (const float each : sums) maximum = std::max(maximum, std::fabs(static_cast<double>(each)));
    for (const Kernels* table : all_tables()) {
      for (int channels = 1; channels <= 3; ++channels) {
        const std::size_t parts = static_cast<std::size_t>(2 * channels), index = parts / 2 - 1;
        std::vector<float> some, few(rows.size() / 6 * parts), those,
            out(static_cast<std::size_t>(degrees) * parts);
        for (std::size_t i = 0; i < coefficients.size(); ++i) {
          if (i % 6 < parts) some.push_back(coefficients[i]);
        }
        for (std::size_t i = 0; i < rows.size(); ++i) {
          if (i / 8 % 6 < parts) those.push_back(rows[i]);
        }
        table->synthesise[index](latitudes, r, kDegree, some.data(), few.data());
        for (std::size_t i = 0; i < few.size(); ++i)
          EXPECT_NEAR(static_cast<double>(few[i]), static_cast<double>(those[i]), 1e-5 * largest);
        table->analyse[index](latitudes, r, kDegree, those.data(), work.data(), out.data());
        for (std::size_t i = 0; i < out.size(); ++i)
          EXPECT_NEAR(static_cast<double>(out[i]), static_cast<double>(sums[i / parts * 6 + i % parts]),
                      1e-5 * maximum);
      }
    }
  }
}

}  // namespace
}  // namespace welkin::prefilter
