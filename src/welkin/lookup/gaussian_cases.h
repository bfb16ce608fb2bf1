#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "welkin/lookup/cone.h"
#include "welkin/lookup/cone_reference.h"
#include "welkin/map/texel_points.h"

/// What tests and benchmarks of Gaussian look-ups share: the mean over a cone by its definition, in float64.
namespace welkin::test {

/// Texels of a map as points: Gauss's 2×2 in each, those of irregular ones as append_points finds them.
class GaussianReference {
 public:
  explicit GaussianReference(const Map& map) : channels_(static_cast<std::size_t>(map.channels())) {
    const ChartSize size{map.width(), map.height()};
    const sphere::AnyParameterization& p = map.parameterization;
    texel_ = mean_texel(p, size);
    std::vector<TexelPoint> points;
    for (int chart = 0; chart < map.charts(); ++chart) {
      for (int y = 0; y < map.height(); ++y) {
        const std::vector<TexelKind> kinds = texel_kinds(p, size, chart, y);
        for (int x = 0; x < map.width(); ++x) {
          const TexelKind kind = kinds[static_cast<std::size_t>(x)];
          if (kind == TexelKind::outside) continue;
          points.clear();
          if (kind == TexelKind::plain) {
            append_gauss_points(p, texel_cell(size, chart, x, y), points);
          } else {
            append_points(p, texel_cell(size, chart, x, y), texel_limits(p, size), points);
          }
          const float* values = map.level.chart(chart).at(x, y);
          for (const TexelPoint& point : points) {
            // From the map's frame to the world's.
            const Matrix3 to_world = transpose(map.orientation);
            directions_.push_back(to_world * point.direction);
            for (std::size_t c = 0; c < channels_; ++c) light_.push_back(point.solid_angle * values[c]);
          }
        }
      }
    }
  }

  /// Side of a mean texel, radians.
  double texel() const { return texel_; }

  /// The map's mean over the sphere.
  std::vector<double> mean() const {
    std::vector<double> sums(channels_);
    for (std::size_t i = 0; i < light_.size(); ++i) sums[i % channels_] += light_[i] / (4 * kPi);
    return sums;
  }

  /// The von Mises–Fisher distribution of `narrow`, spread along the great circle by a wrapped Gaussian: by
  /// steps of a third of `narrow`, whose ripple is below 1e-30.
  std::vector<double> mean(const EllipticalCone& cone) const {
    const Vec3d d = normalize(Vec3d{cone.direction.x, cone.direction.y, cone.direction.z});
    const double narrow = cone.narrow;
    const double sigma = std::sqrt(std::max(0.0, double{cone.wide} * cone.wide - narrow * narrow));
    Vec3d a{0, 0, 0};
    if (sigma > 0) {
      const Vec3d axis{cone.axis.x, cone.axis.y, cone.axis.z};
      a = normalize(axis - dot(axis, d) * d);
    }
    const double kappa = vmf_concentration(narrow);
    const double peak = kappa / (2 * kPi * -std::expm1(-2 * kappa));

    std::vector<Vec3d> taps;
    std::vector<double> weights;
    double total = 0;
    const double step = sigma > 0 ? std::min(narrow, sigma) / 3 : 1;
    const int reach = sigma > 0 ? static_cast<int>(std::ceil(7 * sigma / step)) : 0;
    for (int i = -reach; i <= reach; ++i) {
      const double angle = i * step;
      taps.push_back(std::cos(angle) * d + std::sin(angle) * a);
      weights.push_back(sigma > 0 ? std::exp(-0.5 * angle * angle / (sigma * sigma)) : 1);
      total += weights.back();
    }

    std::vector<double> sums(channels_);
    const Vec3d pole = cross(d, a);
    // exp(−40) is left out.
    const double least = 1 - 40 / kappa;
    for (std::size_t i = 0; i < directions_.size(); ++i) {
      const Vec3d& p = directions_[i];
      const double off = dot(p, pole);
      if (sigma > 0 && 1 - off * off < (least > 0 ? least * least : 0)) continue;
      if (sigma == 0 && dot(p, d) < least) continue;
      std::size_t first = 0, last = taps.size();
      if (sigma > 0 && 7 * sigma < kPi / 2 && least > 0.5) {
        // Only taps near the point's own angle along the circle.
        const double angle = std::atan2(dot(p, a), dot(p, d)), far = std::acos(least);
        const double middle = reach + angle / step, around = far / step + 1;
        first = static_cast<std::size_t>(std::clamp(middle - around, 0.0, double(taps.size())));
        last = static_cast<std::size_t>(std::clamp(middle + around, 0.0, double(taps.size())));
      }
      double weight = 0;
      for (std::size_t k = first; k < last; ++k)
        weight += weights[k] * std::exp(kappa * (dot(p, taps[k]) - 1));
      if (weight == 0) continue;
      for (std::size_t c = 0; c < channels_; ++c) sums[c] += weight * light_[i * channels_ + c];
    }
    for (double& sum : sums) sum *= peak / total;
    return sums;
  }

 private:
  std::size_t channels_;
  double texel_ = 0;
  std::vector<Vec3d> directions_;
  std::vector<double> light_;
};

}  // namespace welkin::test
