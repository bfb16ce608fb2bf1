#include "welkin/prefilter/spline_grid.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "welkin/filter/fetch.h"
#include "welkin/map/borders.h"
#include "welkin/math/vec.h"

namespace welkin::prefilter {
namespace {

/// Real harmonics of order m times cos m(φ + 1): sin^m θ · p(cos θ), φ from +Z toward +X.
struct Term {
  int order;
  double factor, slope;

  double value(double theta, double phi) const {
    const double x = std::cos(theta);
    return factor * (1 + slope * x * x * x) * std::pow(std::sin(theta), order) * std::cos(order * (phi + 1));
  }
};

const Term kTerms[] = {{0, 1, -0.3}, {1, 0.4, 0.7}, {2, -0.3, 0.5}, {3, 0.2, -0.4}};

double function(double theta, double phi, int channel) {
  double sum = 0;
  for (const Term& term : kTerms) sum += term.value(theta, phi);
  return (channel + 1) * sum;
}

/// Coefficients of the function: along rows by the transform of the sampled B-spline, (2 + cos ω)/3.
Level grid_of(int height, int channels, int strip) {
  const int width = 2 * height;
  Level grid(1, width, height, channels);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double theta = (y + 0.5) * kPi / height, phi = 2 * kPi * (0.5 - (x + 0.5) / width);
      double sum = 0;
      for (const Term& term : kTerms)
        sum += term.value(theta, phi) * 3 / (2 + std::cos(2 * kPi * term.order / width));
      for (int c = 0; c < channels; ++c) grid.chart(0).at(x, y)[c] = static_cast<float>(6 * (c + 1) * sum);
    }
  }
  for (int x = 0; x < height; x += strip) to_spline_columns(grid, x, std::min(height, x + strip));
  fill_borders(sphere::AnyParameterization::make("latlong"), grid);
  return grid;
}

/// The largest error at positions (u, v).
double error_at(const Level& grid, const std::vector<float>& u, const std::vector<float>& v) {
  const int channels = grid.channels();
  std::vector<float> chart(u.size()), out(u.size() * static_cast<std::size_t>(channels) + 8);
  fetch_kernels(channels).b_spline(view_of(grid), chart.data(), u.data(), v.data(), out.data(), u.size());
  double worst = 0;
  for (std::size_t i = 0; i < u.size(); ++i) {
    for (int c = 0; c < channels; ++c) {
      const double expected =
          function(static_cast<double>(v[i]) * kPi, 2 * kPi * (0.5 - static_cast<double>(u[i])), c);
      const double got =
          static_cast<double>(out[i * static_cast<std::size_t>(channels) + static_cast<std::size_t>(c)]);
      worst = std::max(worst, std::fabs(got - expected) / (c + 1));
    }
  }
  return worst;
}

/// Rounding of the positions in u and v and of the coefficients: 2e-6 of a function of about 1.
TEST(SplineGrid, HasTheFunctionsValuesAtItsPoints) {
  for (const int height : {4, 8, 10, 32, 90}) {
    for (const int channels : {1, 3, 5}) {
      const Level grid = grid_of(height, channels, 3);
      std::vector<float> u, v;
      for (int i = 0; i < 2 * height * height; ++i) {
        u.push_back((static_cast<float>(i % (2 * height)) + 0.5f) / static_cast<float>(2 * height));
        v.push_back((static_cast<float>(i / (2 * height)) + 0.5f) / static_cast<float>(height));
      }
      u.resize((u.size() + 15) / 16 * 16, 0.5f / static_cast<float>(2 * height));
      v.resize(u.size(), 0.5f / static_cast<float>(height));
      EXPECT_LT(error_at(grid, u, v), 4e-6) << height << ' ' << channels;
    }
  }
}

/// Between them the error falls as the fourth power of the step (Unser 1993, part I): across the poles and
/// the seam too, where half of these positions lie.
TEST(SplineGrid, FollowsTheFunctionBetweenPolesAndSeam) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> position, near(0, 0.03f);
  std::vector<float> u, v;
  for (int i = 0; i < 4096; ++i) {
    u.push_back(i % 4 == 0 ? near(random) : i % 4 == 1 ? 1 - near(random) : position(random));
    v.push_back(i % 8 < 2 ? near(random) : i % 8 < 4 ? 1 - near(random) : position(random));
  }
  double before = 1;
  for (const int height : {8, 16, 32, 64}) {
    const double error = error_at(grid_of(height, 1, 64), u, v);
    EXPECT_LT(error, std::max(before / 11, 4e-6)) << height;
    before = error;
  }
  EXPECT_LT(before, 1e-5);
}

/// A channel of the rows that are wanted is filled, and nothing else.
TEST(SplineGrid, TakesRowsFromLanes) {
  constexpr int kWidth = 150;
  Level grid(1, kWidth, 20, 3);
  std::vector<float> lanes;
  for (int i = 0; i < kWidth * 16; ++i) lanes.push_back(static_cast<float>(i + 1));
  std::array<float*, 16> rows{};
  for (int lane = 0; lane < 16; lane += 3)
    rows[static_cast<std::size_t>(lane)] = grid.chart(0).row(lane + 2) + 1;
  store_lanes(lanes.data(), rows, grid);
  for (int y = 0; y < 20; ++y) {
    const bool wanted = y >= 2 && y < 18 && (y - 2) % 3 == 0;
    for (int x = 0; x < kWidth; ++x) {
      const float* texel = grid.chart(0).row(y) + x * 3;
      EXPECT_EQ(texel[0], 0);
      EXPECT_EQ(texel[1], wanted ? static_cast<float>(x * 16 + y - 2 + 1) : 0.0f) << x << ' ' << y;
      EXPECT_EQ(texel[2], 0);
    }
  }
}

}  // namespace
}  // namespace welkin::prefilter
