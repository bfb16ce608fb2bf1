#include "welkin/light/importance.h"

#include <gtest/gtest.h>

#include "welkin/light/importance_cases.h"
#include "welkin/map/texel_points.h"

namespace welkin {
namespace {

using namespace importance_cases;

using cases::for_each_valid_texel;
using cases::make_map;

/// Parameterizations, windows, and lenses that end in the middle of charts.
std::vector<std::string> all_specs() {
  std::vector<std::string> specs = cases::names_and_windows();
  for (const char* each : {"fisheye-equidistant,fov=220", "fisheye-orthographic,fov=120"})
    specs.push_back(each);
  return specs;
}

/// ∫ f dω over what a map shows: f(direction, chart, x, y), by float64 midpoints of a grid in every texel.
template <class F>
double integrate(const Map& map, int grid, const F& f) {
  const auto& p = map.parameterization;
  const Matrix3 to_world = transpose(map.orientation);
  const double area = 1.0 / (static_cast<double>(map.width()) * map.height() * grid * grid);
  double sum = 0;
  for (int chart = 0; chart < map.charts(); ++chart) {
    for (int j = 0; j < map.height() * grid; ++j) {
      for (int i = 0; i < map.width() * grid; ++i) {
        const double u = (i + 0.5) / (map.width() * grid), v = (j + 0.5) / (map.height() * grid);
        if (!p.valid(chart, u, v)) continue;
        sum += f(to_world * p.to_sphere(chart, u, v), chart, i / grid, j / grid) *
               p.solid_angle_density(chart, u, v) * area;
      }
    }
  }
  return sum;
}

/// Probability that a χ² of so many degrees of freedom exceeds `x` (Wilson & Hilferty 1931).
double chi_square_tail(double x, double freedom) {
  const double a = 2 / (9 * freedom);
  return 0.5 * std::erfc((std::cbrt(x / freedom) - (1 - a)) / std::sqrt(2 * a));
}

/// A bin of directions: of 10 heights and 20 azimuths about an axis that no parameterization has.
constexpr int kBins = 200;
int bin_of(const Vec3d& direction) {
  static const Matrix3 turn = rotation_from_yaw_pitch_roll(37, 61, 11);
  const Vec3d d = turn * direction;
  const int height = std::clamp(static_cast<int>((d.y + 1) * 5), 0, 9);
  const int azimuth = std::clamp(static_cast<int>((std::atan2(d.x, d.z) / kPi + 1) * 10), 0, 19);
  return height * 20 + azimuth;
}

class Importance : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(All, Importance, ::testing::ValuesIn(all_specs()), cases::test_name);

/// Frequencies of draws against ∫ pdf over bins of directions, by a million points: some 5000 a bin, so that
/// what its border cuts wrong is 2e-3 of it, while the number of draws in it deviates by 4e-2. With Šidák's
/// correction a right sampler fails one run of all tests in a hundred; seeds are fixed.
TEST_P(Importance, DrawsAreDistributedAsPdfSays) {
  const double tests = 2.0 * static_cast<double>(all_specs().size());
  const double significance = 1 - std::pow(1 - 0.01, 1 / tests);
  const Map map = random_map(GetParam(), 6);
  for (const ImportanceMethod method : kMethods) {
    const ImportanceSampler sampler(map, {.method = method});
    std::vector<double> expected(kBins), seen(kBins);
    const auto& p = map.parameterization;
    const double texels = static_cast<double>(map.charts()) * map.width() * map.height();
    const int grid = 8 * static_cast<int>(std::ceil(std::sqrt(1e6 / texels) / 8));
    for (int chart = 0; chart < map.charts(); ++chart) {
      for (int j = 0; j < map.height() * grid; ++j) {
        for (int i = 0; i < map.width() * grid; ++i) {
          const double u = (i + 0.5) / (map.width() * grid), v = (j + 0.5) / (map.height() * grid);
          if (!p.valid(chart, u, v)) continue;
          const Vec3d d = transpose(map.orientation) * p.to_sphere(chart, u, v);
          expected[static_cast<std::size_t>(bin_of(d))] +=
              sampler.pdf(d) * p.solid_angle_density(chart, u, v);
        }
      }
    }
    const double scale = 1.0 / (static_cast<double>(map.width()) * map.height() * grid * grid);
    constexpr int kDraws = 100'000;
    std::mt19937_64 random(42);
    std::uniform_real_distribution<double> u(0, 1);
    for (int i = 0; i < kDraws; ++i) {
      const double u1 = u(random), u2 = u(random);
      seen[static_cast<std::size_t>(bin_of(sampler.draw(u1, u2).direction))] += 1;
    }
    // Bins where few are expected count as one.
    double statistic = 0, few_expected = 0, few_seen = 0;
    int bins = 0;
    for (std::size_t b = 0; b < kBins; ++b) {
      const double mean = expected[b] * scale * kDraws;
      if (mean < 20) {
        few_expected += mean;
        few_seen += seen[b];
        continue;
      }
      statistic += (seen[b] - mean) * (seen[b] - mean) / mean;
      ++bins;
    }
    if (few_expected > 5) {
      statistic += (few_seen - few_expected) * (few_seen - few_expected) / few_expected;
      ++bins;
    } else {
      EXPECT_LE(few_seen, few_expected + 20);
    }
    if (bins < 2) continue;
    EXPECT_GT(chi_square_tail(statistic, bins - 1), significance) << name_of(method) << ' ' << bins;
  }
}

/// By midpoints: exact where draws are even over (u, v); the tolerance is for cells that rims cut.
TEST_P(Importance, PdfIntegratesToOne) {
  const Map map = random_map(GetParam(), 6);
  for (const ImportanceMethod method : kMethods) {
    const ImportanceSampler sampler(map, {.method = method});
    const double integral = integrate(map, 64, [&](const Vec3d& d, int, int, int) { return sampler.pdf(d); });
    EXPECT_NEAR(integral, 1, map.parameterization.full_charts() ? 1e-5 : 1e-2) << name_of(method);
  }
}

/// The same, by directions that know nothing of texels: Fibonacci's spiral.
TEST_P(Importance, PdfIntegratesToOneOverTheSphere) {
  const ImportanceSampler sampler(random_map(GetParam(), 6));
  constexpr int kCount = 200'000;
  double sum = 0;
  for (int i = 0; i < kCount; ++i) {
    const double y = 1 - (2 * i + 1.0) / kCount, r = std::sqrt(1 - y * y), a = 2.39996322972865332 * i;
    sum += sampler.pdf({r * std::cos(a), y, r * std::sin(a)}) * 4 * kPi / kCount;
  }
  // Of a window of a degree there are too few.
  if (sampler.frame().parameterization.coverage() < 1) return;
  EXPECT_NEAR(sum, 1, 0.02);
}

/// How far a position is from the edges of the parts in which texels are drawn, in texels.
double distance_from_edges(const ImportanceSampler& sampler, const Vec3d& direction) {
  const MapFrame& frame = sampler.frame();
  const auto at = frame.parameterization.from_sphere(frame.orientation * direction);
  const auto distance = [](double place) { return std::fabs(place - std::round(place)) / 8; };
  return std::min(distance(8 * at.u * frame.size.width), distance(8 * at.v * frame.size.height));
}

/// draw and pdf are one function. Numbers at the ends of [0, 1) and on the edges of texels give directions
/// there: where a pole or a rim magnifies rounding, it may put these into the next texel, or over the end of
/// the line from rim to rim that they are drawn on.
TEST_P(Importance, DrawSaysWhatPdfSays) {
  const double ends[] = {0, 1e-17, 0.125, 0.25, 0.5, 0.75, 1 - 0x1p-53, 1, 2, -1};
  for (const int size : {1, 2, 5, 16}) {
    const Map map = random_map(GetParam(), size);
    for (const ImportanceMethod method : kMethods) {
      for (const bool compensate : {false, true}) {
        const ImportanceSampler sampler(map, {.method = method, .compensate = compensate});
        const auto draw_with = [&](double u1, double u2) {
          const ImportanceDraw draw = sampler.draw(u1, u2);
          EXPECT_GT(draw.pdf, 0) << u1 << ' ' << u2;
          EXPECT_NEAR(length(draw.direction), 1, 1e-12);
          EXPECT_GT(luminance(map.level.chart(draw.chart).at(draw.x, draw.y)), 0);
          EXPECT_GT(sampler.probability(draw.chart, draw.x, draw.y), 0);
          return draw;
        };
        std::mt19937_64 random(1);
        std::uniform_real_distribution<double> u(0, 1);
        for (int i = 0; i < 2000; ++i) {
          const double u1 = u(random), u2 = u(random);
          const ImportanceDraw draw = draw_with(u1, u2);
          ASSERT_NEAR(sampler.pdf(draw.direction) / draw.pdf, 1, 1e-6)
              << name_of(method) << ' ' << size << ": " << u1 << ' ' << u2 << " texel " << draw.chart << ' '
              << draw.x << ' ' << draw.y;
        }
        for (const double u1 : ends) {
          for (const double u2 : ends) {
            const ImportanceDraw draw = draw_with(u1, u2);
            if (std::fabs(sampler.pdf(draw.direction) / draw.pdf - 1) < 1e-6) continue;
            if (!map.parameterization.full_charts()) continue;
            EXPECT_LT(distance_from_edges(sampler, draw.direction), 1e-7) << u1 << ' ' << u2;
          }
        }
      }
    }
  }
}

/// E[L/pdf] = ∫ L dω, and L/pdf hardly varies: that is what the tables are for. Within a texel the density
/// changes by 25 %, in parts of texels that rims cut by more. The integral is by midpoints: 1e-2 where the
/// density of fisheye-orthographic grows without bound towards the rim.
TEST_P(Importance, MeanOfRadianceOverPdfIsTheIntegral) {
  const Map map = random_map(GetParam(), 12);
  const double exact = integrate(map, 64, [&](const Vec3d&, int chart, int x, int y) {
    return luminance(map.level.chart(chart).at(x, y));
  });
  for (const ImportanceMethod method : kMethods) {
    const ImportanceSampler sampler(map, {.method = method});
    double sum = 0, squares = 0;
    const auto numbers = stratified(128, 3);
    for (const auto& [u1, u2] : numbers) {
      const ImportanceDraw draw = sampler.draw(u1, u2);
      const double value = luminance(map.level.chart(draw.chart).at(draw.x, draw.y)) / draw.pdf;
      sum += value;
      squares += value * value;
    }
    const double count = static_cast<double>(numbers.size()), mean = sum / count;
    const double deviation = std::sqrt(std::max(squares / count - mean * mean, 0.0));
    EXPECT_NEAR(mean / exact, 1,
                4 * deviation / mean / std::sqrt(count) + (map.parameterization.full_charts() ? 1e-3 : 1e-2))
        << name_of(method);
    EXPECT_LT(deviation / mean, map.parameterization.full_charts() ? 0.12 : 0.3) << name_of(method);
    EXPECT_NEAR(sampler.integral() / exact, 1, map.parameterization.full_charts() ? 2e-3 : 1e-2);
  }
}

/// The probability of texels: luminance × solid angle.
TEST_P(Importance, TexelsAreDrawnByLuminanceTimesSolidAngle) {
  const Map map = random_map(GetParam(), 12);
  const ImportanceSampler cdf(map), alias(map, {.method = ImportanceMethod::alias});
  double total = 0;
  std::vector<double> weights;
  for (int chart = 0; chart < map.charts(); ++chart) {
    for (int y = 0; y < map.height(); ++y) {
      const std::vector<double> omega =
          summed_solid_angles(map.parameterization, {map.width(), map.height()}, chart, y);
      for (int x = 0; x < map.width(); ++x) {
        weights.push_back(omega[static_cast<std::size_t>(x)] * luminance(map.level.chart(chart).at(x, y)));
        total += weights.back();
      }
    }
  }
  std::size_t i = 0;
  for (int chart = 0; chart < map.charts(); ++chart) {
    for (int y = 0; y < map.height(); ++y) {
      for (int x = 0; x < map.width(); ++x, ++i) {
        const double p = cdf.probability(chart, x, y), q = alias.probability(chart, x, y);
        // Solid angles of texels in small charts: 1e-3. Thresholds of the alias table are floats.
        EXPECT_NEAR(p, weights[i] / total, 2e-3 * weights[i] / total + 1e-9);
        EXPECT_NEAR(q, p, 1e-6 * p + 1e-9);
        if (luminance(map.level.chart(chart).at(x, y)) == 0) {
          EXPECT_EQ(p, 0);
          EXPECT_EQ(q, 0);
        }
      }
    }
  }
}

/// As compensation has it: what is at or below the mean is never drawn, the rest by its excess.
TEST_P(Importance, CompensationDrawsTheExcessOverTheMean) {
  const Map map = random_map(GetParam(), 12);
  const ImportanceSampler plain(map);
  const double mean = plain.mean_luminance();
  EXPECT_NEAR(mean * map.parameterization.coverage() / plain.integral(), 1, 2e-3);
  for (const ImportanceMethod method : kMethods) {
    const ImportanceSampler sampler(map, {.method = method, .compensate = true});
    double ratio = 0;
    for_each_valid_texel(map, [&](int chart, int x, int y) {
      const double excess = luminance(map.level.chart(chart).at(x, y)) - mean;
      const double p = sampler.probability(chart, x, y);
      if (excess <= 0) {
        EXPECT_EQ(p, 0);
        return;
      }
      const double omega_share = plain.probability(chart, x, y) / (excess + mean);
      if (p == 0 || omega_share == 0 || excess < 1e-3 * mean) return;
      if (ratio == 0) ratio = p / (excess * omega_share);
      EXPECT_NEAR(p / (excess * omega_share) / ratio, 1, 1e-3);
    });
    EXPECT_GT(ratio, 0);
  }
}

/// Where only one texel has light, all draws lie in it, and nowhere else is any density.
TEST_P(Importance, OneLightIsDrawnAlways) {
  Map map = make_map(GetParam(), 9);
  const int chart = map.charts() - 1;
  *map.level.chart(chart).at(map.width() / 2, map.height() / 2) = 3;
  fill_borders(map);
  for (const ImportanceMethod method : kMethods) {
    const ImportanceSampler sampler(map, {.method = method});
    for (const auto& [u1, u2] : stratified(16, 1)) {
      const ImportanceDraw draw = sampler.draw(u1, u2);
      ASSERT_EQ(draw.chart, chart);
      ASSERT_EQ(draw.x, map.width() / 2);
      ASSERT_EQ(draw.y, map.height() / 2);
    }
    for_each_valid_texel(map, [&](int c, int x, int y) {
      const bool lit = c == chart && x == map.width() / 2 && y == map.height() / 2;
      EXPECT_EQ(sampler.pdf(cases::direction_at(map, c, x, y)) > 0, lit);
    });
  }
}

/// A black map, and one of one radiance when it is compensated, are drawn evenly.
TEST_P(Importance, WithoutLightDrawsAreEven) {
  Map map = make_map(GetParam(), 7);
  const double even = 1 / map.parameterization.coverage();
  const auto is_even = [&](const ImportanceSampler& sampler) {
    EXPECT_TRUE(sampler.is_uniform());
    for_each_valid_texel(map, [&](int chart, int x, int y) {
      const double pdf = sampler.pdf(cases::direction_at(map, chart, x, y));
      // Within a texel, 25 %; parts of texels that rims cut by 50 %.
      EXPECT_NEAR(pdf / even, 1, map.parameterization.full_charts() ? 0.3 : 1)
          << chart << ' ' << x << ' ' << y;
    });
  };
  for (const ImportanceMethod method : kMethods) {
    is_even(ImportanceSampler(map, {.method = method}));
    cases::render(map, [](const Vec3d&) { return 0.7; });
    is_even(ImportanceSampler(map, {.method = method, .compensate = true}));
    EXPECT_FALSE(ImportanceSampler(map, {.method = method}).is_uniform());
    cases::render(map, [](const Vec3d&) { return 0; });
  }
}

/// Wherever bilinear radiance is above 0, so is the density, though most texels are black.
TEST_P(Importance, BilinearWeightsReachAsFarAsTheFilter) {
  Map map = make_map(GetParam(), 10);
  *map.level.chart(0).at(map.width() / 3, map.height() / 2) = 1;
  fill_borders(map);
  const ImportanceSampler near(map), wide(map, {.look_up = Filter::bilinear});
  const int x = map.width() / 3, y = map.height() / 2;
  EXPECT_GT(near.probability(0, x, y), 0);
  for (int j = -1; j <= 1; ++j) {
    for (int i = -1; i <= 1; ++i) {
      if (!cases::is_valid_texel(map, 0, x + i, y + j)) continue;
      EXPECT_GT(wide.probability(0, x + i, y + j), 0) << i << ' ' << j;
    }
  }
  EXPECT_EQ(near.probability(0, x + 1, y), 0);
}

}  // namespace
}  // namespace welkin
