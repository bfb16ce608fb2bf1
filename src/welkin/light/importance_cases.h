#pragma once

#include <random>
#include <utility>
#include <vector>

#include "welkin/light/importance.h"
#include "welkin/map/map_cases.h"
#include "welkin/math/rotation.h"

/// What the tests of importance sampling share.
namespace welkin::importance_cases {

inline constexpr ImportanceMethod kMethods[] = {ImportanceMethod::cdf, ImportanceMethod::alias};

/// A map of random radiance of three decades with black texels and a light among them, turned.
inline Map random_map(const std::string& spec, int size, unsigned seed = 7) {
  Map map = cases::make_map(spec, size, 3);
  map.orientation = rotation_from_yaw_pitch_roll(25, -40, 70);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> u(0, 1);
  for (int chart = 0; chart < map.charts(); ++chart) {
    for (int y = 0; y < map.height(); ++y) {
      for (int x = 0; x < map.width(); ++x) {
        const bool black = u(random) < 0.25;
        for (int c = 0; c < 3; ++c)
          map.level.chart(chart).at(x, y)[c] =
              black ? 0.0f : static_cast<float>(std::pow(10, 3 * u(random) - 2));
      }
    }
  }
  map.level.chart(0).at(map.width() / 2, map.height() / 2)[1] = 100;
  fill_borders(map);
  return map;
}

inline double luminance(const float* rgb) {
  return 0.2126 * static_cast<double>(rgb[0]) + 0.7152 * static_cast<double>(rgb[1]) +
         0.0722 * static_cast<double>(rgb[2]);
}

/// Numbers in [0,1)², one in each cell of a grid of side × side, in random order.
inline std::vector<std::pair<double, double>> stratified(int side, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> u(0, 1);
  std::vector<std::pair<double, double>> numbers;
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) numbers.push_back({(i + u(random)) / side, (j + u(random)) / side});
  }
  return numbers;
}

}  // namespace welkin::importance_cases
