#include "eevee_sun.h"

#include <algorithm>
#include <vector>

namespace welkin::bench {

EeveeSun eevee_sun(const Map& map, double threshold) {
  EeveeSun sun;
  Vec3d sum{0, 0, 0};
  double weight = 0;
  std::vector<float> omega(static_cast<std::size_t>(map.width()));
  for (int chart = 0; chart < map.charts(); ++chart) {
    for (int y = 0; y < map.height(); ++y) {
      texel_solid_angles(map.parameterization, map.width(), map.height(), chart, y, omega.data());
      for (int x = 0; x < map.width(); ++x) {
        const float* texel = map.level.chart(chart).at(x, y);
        const double brightest = static_cast<double>(*std::max_element(texel, texel + map.channels()));
        if (!(brightest > threshold)) continue;
        const double part = 1 - threshold / brightest,
                     angle = static_cast<double>(omega[static_cast<std::size_t>(x)]);
        const Vec3d d =
            map.parameterization.to_sphere(chart, (x + 0.5) / map.width(), (y + 0.5) / map.height());
        sun.irradiance += part * static_cast<double>(texel[0]) * angle;
        sum = sum + part * brightest * angle * d;
        weight += part * brightest * angle;
      }
    }
  }
  if (!(weight > 0)) return sun;
  const double shortened = length(sum) / weight;
  sun.direction = transpose(map.orientation) * normalize(sum);
  sun.solid_angle = 2 * kPi * (1 - (2 * shortened - 1));
  return sun;
}

}  // namespace welkin::bench
