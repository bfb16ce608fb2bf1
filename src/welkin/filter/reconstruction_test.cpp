#include "welkin/filter/reconstruction.h"

#include <gtest/gtest.h>

#include "welkin/map/map_cases.h"

namespace welkin {
namespace {

using namespace cases;

constexpr float kOffsets[2] = {0.21132487f, 0.78867513f}, kHalves[2] = {0.5f, 0.5f};

/// Nothing is a light.
Reconstruction without_lights() {
  static const std::vector<float> never(kMaxChannels, 1e30f);
  Reconstruction how;
  how.bright = never.data();
  return how;
}

Map noise(int channels) {
  Map map = make_map("cube", 24, channels);
  std::mt19937 random(5);
  std::uniform_real_distribution<float> value(0.0f, 1.0f);
  for (int chart = 0; chart < map.charts(); ++chart) {
    for (int y = 0; y < map.height(); ++y) {
      for (int i = 0; i < map.width() * channels; ++i)
        map.level.chart(chart).row(y)[i] = std::pow(value(random), 4.0f);
    }
  }
  fill_borders(map);
  return map;
}

/// Value of coefficient k of a texel's channel c.
double coefficient(const ReconstructedTexels& texels, int k, int x, int y, int c) {
  const std::size_t at = static_cast<std::size_t>(k) * static_cast<std::size_t>(texels.plane()) +
                         texels.index(x, y) * static_cast<std::size_t>(texels.channels) +
                         static_cast<std::size_t>(c);
  return static_cast<double>(texels.coefficients[at]);
}

/// Quadratics whose means are the texels are found as they are.
TEST(ReconstructionTest, QuadraticsAreFoundExactly) {
  Map map(sphere::AnyParameterization::make("latlong"), 32, 16, 1);
  const auto mean_of = [](double x, double y) {  // over a texel around (x, y)
    return 50 + 0.3 * x - 0.2 * y + 0.02 * (x * x + 1.0 / 12) + 0.03 * x * y - 0.05 * (y * y + 1.0 / 12);
  };
  for (int y = -kBorder; y < 16 + kBorder; ++y) {
    for (int x = -kBorder; x < 32 + kBorder; ++x)
      *map.level.chart(0).at(x, y) = static_cast<float>(mean_of(x + 0.5, y + 0.5));
  }
  ReconstructedTexels texels;
  texels.reset(0, 3, 2, 20, 9, 1);
  reconstruction_kernels(1).reconstruct(view_of(map.level), without_lights(), texels);
  for (int y = 2; y < 11; ++y) {
    for (int x = 3; x < 23; ++x) {
      const double cx = x + 0.5, cy = y + 0.5;
      EXPECT_NEAR(coefficient(texels, 1, x, y, 0), 0.3 + 0.04 * cx + 0.03 * cy, 1e-4);
      EXPECT_NEAR(coefficient(texels, 2, x, y, 0), -0.2 + 0.03 * cx - 0.1 * cy, 1e-4);
      EXPECT_NEAR(coefficient(texels, 3, x, y, 0), 0.02, 1e-4);
      EXPECT_NEAR(coefficient(texels, 4, x, y, 0), 0.03, 1e-4);
      EXPECT_NEAR(coefficient(texels, 5, x, y, 0), -0.05, 1e-4);
      EXPECT_NEAR(coefficient(texels, 0, x, y, 0), mean_of(cx, cy) - (0.02 - 0.05) / 12, 2e-5);
    }
  }
}

/// Nothing falls below 0 by more than half of the texel, wherever in it, unless ringing is allowed.
TEST(ReconstructionTest, UndershootIsLimited) {
  Map map = noise(3);
  for (int c = 0; c < 3; ++c) map.level.chart(2).at(11, 9)[c] = 5000;
  fill_borders(map);
  for (const bool limited : {true, false}) {
    double lowest = 0;
    ReconstructedTexels texels;
    texels.reset(2, 4, 4, 16, 16, 3);
    Reconstruction how = without_lights();
    how.limited = limited;
    reconstruction_kernels(3).reconstruct(view_of(map.level), how, texels);
    for (int y = 4; y < 20; ++y) {
      for (int x = 4; x < 20; ++x) {
        for (int c = 0; c < 3; ++c) {
          const auto a = [&](int k) { return coefficient(texels, k, x, y, c); };
          const double mean = static_cast<double>(map.level.chart(2).at(x, y)[c]);
          EXPECT_NEAR(a(0) + (a(3) + a(5)) / 12, mean, 1e-3 + 1e-6 * mean);
          for (int i = 0; i < 9; ++i) {
            const double px = 0.5 * (i % 3 - 1), py = 0.5 * (i / 3 - 1);
            const double value = a(0) + px * (a(1) + px * a(3) + py * a(4)) + py * (a(2) + py * a(5));
            lowest = std::min(lowest, (value + 1e-4) / (mean + 1e-6));
          }
        }
      }
    }
    if (limited) {
      EXPECT_GE(lowest, -0.501);
    } else {
      EXPECT_LT(lowest, -100);
    }
  }
}

TEST(ReconstructionTest, LightsAndUnevenTexelsAreMarked) {
  Map map = make_map("cube", 24);
  for (int chart = 0; chart < 6; ++chart) {
    for (int y = 0; y < 24; ++y) std::fill_n(map.level.chart(chart).row(y), 24, 0.25f);
  }
  *map.level.chart(1).at(12, 10) = 1000;
  // Of a mean of 1, as `bright` says: one that stands out and one that doesn't.
  *map.level.chart(1).at(8, 15) = 0.25f + 1.01f * kUneven;
  *map.level.chart(1).at(16, 16) = 0.25f + 0.99f * kUneven;
  fill_borders(map);
  ReconstructedTexels texels;
  texels.reset(1, 6, 6, 12, 12, 1);
  Reconstruction how;
  const float bright = 8;
  how.bright = &bright;
  reconstruction_kernels(1).reconstruct(view_of(map.level), how, texels);
  texels.count_hard();
  const auto near = [](int x, int y, int to_x, int to_y) {
    return std::abs(x - to_x) <= 1 && std::abs(y - to_y) <= 1;
  };
  for (int y = 6; y < 18; ++y) {
    for (int x = 6; x < 18; ++x) {
      const int wanted = near(x, y, 12, 10) ? kIsLight : near(x, y, 8, 15) ? kIsUneven : 0;
      EXPECT_EQ(texels.hard[texels.index(x, y)], wanted) << x << ' ' << y;
    }
  }
  EXPECT_EQ(texels.hard_in(6, 6, 17, 17), 9 * kLights + 9);
  EXPECT_EQ(texels.hard_in(12, 10, 12, 10), kLights);
  EXPECT_EQ(texels.hard_in(8, 14, 9, 17), 6);
  EXPECT_EQ(texels.hard_in(6, 6, 10, 13), 0);
}

#ifdef WELKIN_HAS_AVX2
TEST(ReconstructionTest, InstructionSetsAgree) {
  for (const int channels : {1, 2, 3, 4, 5, 7}) {
    const Map map = noise(channels);
    std::vector<Quadrilateral> areas;
    std::mt19937 random(3);
    std::uniform_real_distribution<float> at(2.0f, 20.0f), side(-1.5f, 1.5f);
    for (int i = 0; i < 60; ++i) {
      Quadrilateral q;
      const float x = at(random), y = at(random);
      for (int k = 0; k < 4; ++k) {
        q.x[k] = x + side(random);
        q.y[k] = y + side(random);
        q.weight[k] = 1 + 0.1f * static_cast<float>(k);
      }
      areas.push_back(q);
    }
    std::vector<float> means[2];
    ReconstructedTexels texels[2];
    for (int k = 0; k < 2; ++k) {
      const ReconstructionKernels kernels =
          k == 0 ? reconstruction_kernels_baseline(channels) : reconstruction_kernels_avx2(channels);
      texels[k].reset(3, 0, 0, 24, 24, channels);
      kernels.reconstruct(view_of(map.level), without_lights(), texels[k]);
      means[k].resize(areas.size() * static_cast<std::size_t>(channels) + 8);
      const QuadraturePoints points{2, kOffsets, kHalves};
      kernels.means(texels[k], points, points, areas.data(), areas.size(), means[k].data());
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(kCoefficients * texels[0].plane()); ++i)
      ASSERT_NEAR(texels[0].coefficients[i], texels[1].coefficients[i], 2e-5);
    for (std::size_t i = 0; i + 8 < means[0].size(); ++i) ASSERT_NEAR(means[0][i], means[1][i], 2e-4);
  }
}
#endif

}  // namespace
}  // namespace welkin
