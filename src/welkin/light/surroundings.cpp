#include "welkin/light/surroundings.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace welkin {
namespace {

/// Numbers of the points in order of their azimuth about `middle`.
std::vector<std::size_t> around(const std::vector<RimPoint>& points, const Vec3d& middle) {
  const Vec3d across = normalize(cross(middle, std::fabs(middle.y) < 0.9 ? Vec3d{0, 1, 0} : Vec3d{1, 0, 0}));
  const Vec3d up = cross(across, middle);
  std::vector<double> azimuths;
  for (const RimPoint& each : points)
    azimuths.push_back(std::atan2(dot(each.direction, up), dot(each.direction, across)));
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return azimuths[a] != azimuths[b] ? azimuths[a] < azimuths[b] : a < b;
  });
  return order;
}

}  // namespace

Surroundings::Surroundings(const std::vector<RimPoint>& points, const std::vector<float>& values,
                           std::size_t channels, const Vec3d& middle)
    : channels_(channels) {
  if (points.empty()) return;
  const std::size_t count = std::min(points.size(), kMostPoints);
  const std::vector<std::size_t> order = around(points, middle);
  for (std::size_t k = 0; k < count; ++k) {
    RimPoint sum{{0, 0, 0}, 0};
    std::vector<double> mean(channels);
    for (std::size_t i = points.size() * k / count; i < points.size() * (k + 1) / count; ++i) {
      const RimPoint& point = points[order[i]];
      sum.weight += point.weight;
      sum.direction = sum.direction + point.weight * point.direction;
      for (std::size_t c = 0; c < channels; ++c)
        mean[c] += point.weight * static_cast<double>(values[order[i] * channels + c]);
    }
    points_.push_back({(1 / sum.weight) * sum.direction, sum.weight});
    for (const double each : mean) values_.push_back(each / sum.weight);
  }
}

void Surroundings::evaluate(const Vec3d& d, double* values) const {
  std::fill_n(values, channels_, 0.0);
  double total = 0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Vec3d way = points_[i].direction - d;
    const double weight = points_[i].weight / dot(way, way);
    total += weight;
    for (std::size_t c = 0; c < channels_; ++c) values[c] += weight * values_[i * channels_ + c];
  }
  for (std::size_t c = 0; c < channels_; ++c) values[c] /= total;
}

}  // namespace welkin
