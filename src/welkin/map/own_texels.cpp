#include "welkin/map/own_texels.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "welkin/map/texel_points.h"

namespace welkin {

OwnTexels::OwnTexels(const sphere::AnyParameterization& p, const Level& level,
                     const std::vector<BorderTexel>& texels) {
  for (const BorderTexel& each : texels) {
    if (is_outside_texel(p, {level.width(), level.height()}, each.chart, each.x, each.y)) continue;
    const float* const texel = level.chart(each.chart).at(each.x, each.y);
    std::vector<float> values(texel, texel + level.channels());
    const bool finite =
        std::all_of(values.begin(), values.end(), [](float value) { return std::isfinite(value); });
    held_.push_back({each, std::move(values), finite});
  }
}

bool OwnTexels::are_light(const Level& level) const {
  constexpr double kAlike = 0.25;
  std::size_t lit = 0, alike = 0;
  for (const Held& each : held_) {
    const float* const made = level.chart(each.at.chart).at(each.at.x, each.at.y);
    double difference = 0, given = 0;
    for (std::size_t c = 0; c < each.values.size(); ++c) {
      difference += std::fabs(static_cast<double>(each.values[c]) - static_cast<double>(made[c]));
      given += std::fabs(static_cast<double>(made[c]));
    }
    if (!(given > 0) || !each.finite) continue;
    ++lit;
    if (difference <= kAlike * given) ++alike;
  }
  return 2 * alike > lit;
}

void OwnTexels::put_back(Level& level, bool finite_only) const {
  for (const Held& each : held_) {
    if (!each.finite && finite_only) continue;
    std::copy(each.values.begin(), each.values.end(), level.chart(each.at.chart).at(each.at.x, each.at.y));
  }
}

}  // namespace welkin
