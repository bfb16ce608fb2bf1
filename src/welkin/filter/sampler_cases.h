#pragma once

#include "welkin/filter/sampler.h"
#include "welkin/map/map_cases.h"

/// What the tests of look-ups share.
namespace welkin::cases {

/// Every texel has its own value in 0…2; the borders are filled.
inline void fill_with_noise(Map& map) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> value(0, 2);
  for (int chart = 0; chart < map.charts(); ++chart) {
    for (int y = 0; y < map.height(); ++y) {
      for (int i = 0; i < map.width() * map.channels(); ++i) map.level.chart(chart).row(y)[i] = value(random);
    }
  }
  fill_borders(map);
}

/// All over the sphere, of lengths about 1.
inline std::vector<Vec3<float>> random_directions(std::size_t count) {
  std::mt19937 random(1);
  std::normal_distribution<float> along;
  std::vector<Vec3<float>> directions(count);
  for (auto& d : directions) d = {along(random), along(random), along(random)};
  return directions;
}

/// From 0 to the sampler's coarsest level; a third of them are whole numbers.
inline std::vector<float> random_levels(const Sampler& sampler, std::size_t count) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> level(0, static_cast<float>(sampler.levels() - 1));
  std::vector<float> levels(count);
  for (std::size_t i = 0; i < count; ++i) levels[i] = i % 3 == 0 ? std::floor(level(random)) : level(random);
  return levels;
}

}  // namespace welkin::cases
