#pragma once

#include <cmath>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "welkin/brdf/view_lobe.h"

/// Which errors count: those that light of surroundings would show. Internal to brdf.
namespace welkin::brdf {

/// The power of light at degree l ≥ 1, for each coefficient: as l^−2, which is that of plane pictures. Few
/// small lights are nearer to l^−1 or less, large areas to l^−3; an axis or a sum that is best for l^−2 is
/// within a tenth of the best for either.
inline double light_power(int degree) {
  return 1 / ((degree + 0.5) * (degree + 0.5));
}

/// A lobe's points on one side of the plane of incidence, with the weights of both, normalised to 1; those in
/// one cell of `step` radians become one in their middle.
struct MergedPoints {
  std::vector<Vec3d> directions;
  std::vector<double> weights;
};

inline MergedPoints merged(const LobePoints& points, double step) {
  std::map<std::pair<int, int>, std::pair<Vec3d, double>> cells;
  double whole = 0;
  for (std::size_t i = 0; i < points.directions.size(); ++i) {
    const Vec3d d{points.directions[i].x, std::fabs(points.directions[i].y), points.directions[i].z};
    const double weight = points.weights[i], elevation = std::atan2(d.z, -d.x),
                 beta = std::asin(std::min(1.0, d.y));
    auto& [sum, total] = cells[{static_cast<int>(elevation / step), static_cast<int>(beta / step)}];
    sum = sum + weight * d;
    total += weight;
    whole += weight;
  }
  MergedPoints result;
  for (const auto& [cell, each] : cells) {
    if (!(each.second > 1e-9 * whole)) continue;
    result.directions.push_back(normalize(each.first));
    result.weights.push_back(each.second / whole);
  }
  return result;
}

}  // namespace welkin::brdf
