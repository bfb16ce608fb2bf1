#pragma once

#include <vector>

#include "welkin/math/vec.h"

/// What would be seen where a light is, if it weren't there. Internal to light.
namespace welkin {

/// Values that are known beside a light.
struct RimPoint {
  Vec3d direction;
  double weight;  ///< the length of rim that it stands for
};

/// Interpolates from a rim inward: the mean of its values, weighted by 1/distance². On a disc that is
/// Poisson's integral, the smoothest surface through its rim. Of rims of over kMostPoints, points that lie
/// side by side are averaged first.
class Surroundings {
 public:
  static constexpr std::size_t kMostPoints = 256;

  /// `values`: `channels` for each point. `middle`: a direction within the rim.
  Surroundings(const std::vector<RimPoint>& points, const std::vector<float>& values, std::size_t channels,
               const Vec3d& middle);

  bool empty() const { return points_.empty(); }
  /// One value for each channel along d, which isn't the direction of a point.
  void evaluate(const Vec3d& d, double* values) const;

 private:
  std::size_t channels_;
  std::vector<RimPoint> points_;
  std::vector<double> values_;
};

}  // namespace welkin
