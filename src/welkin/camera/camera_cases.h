#pragma once

#include <array>
#include <functional>

#include "welkin/map/borders.h"
#include "welkin/map/map_cases.h"

/// Worlds that the tests of cameras look at.
namespace welkin::cases {

using Colour = std::array<double, 3>;

/// R, G and B of every direction, in charts of that width.
inline Map coloured_world(const char* parameterization, int width,
                          const std::function<Colour(const Vec3d&)>& colour) {
  const auto p = sphere::AnyParameterization::make(parameterization);
  Map map(p, width, static_cast<int>(width / p.aspect()), 3);
  for_each_valid_texel(map, [&](int chart, int x, int y) {
    const Colour values = colour(direction_at(map, chart, x, y));
    for (int c = 0; c < 3; ++c)
      map.level.chart(chart).at(x, y)[c] = static_cast<float>(values[static_cast<std::size_t>(c)]);
  });
  fill_borders(map);
  return map;
}

}  // namespace welkin::cases
