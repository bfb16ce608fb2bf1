#include "welkin/lookup/cone_reference.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "welkin/base/error.h"
#include "welkin/lookup/tangent_plane.h"
#include "welkin/math/angles.h"
#include "welkin/math/vec_precision.h"

namespace welkin {
namespace {

/// 1 − (coth κ − 1/κ).
double missing_cosine(double concentration) {
  if (concentration < 1e-3) return 1 - concentration / 3;
  return 1 / concentration - 2 / std::expm1(2 * concentration);
}

void require_sound(const std::string& fault) {
  require(fault.empty(), fault.c_str());
}

/// Caps that the texels of a row lie in: about their centres, past their corners by a fifth for curved sides.
class RowCaps {
 public:
  RowCaps(const sphere::AnyParameterization& p, const Map& map, int chart, int row) {
    const auto at = [&](double x, double y) { return p.to_sphere(chart, x / map.width(), y / map.height()); };
    Vec3d above = at(0, row), below = at(0, row + 1);
    for (int x = 0; x < map.width(); ++x) {
      const Vec3d next_above = at(x + 1, row), next_below = at(x + 1, row + 1);
      centres_.push_back(at(x + 0.5, row + 0.5));
      double radius = 0;
      for (const Vec3d& corner : {above, below, next_above, next_below}) {
        radius = std::max(radius, angle_between(centres_.back(), corner));
      }
      radii_.push_back(1.2 * radius);
      above = next_above;
      below = next_below;
    }
  }
  const Vec3d& centre(int x) const { return centres_[static_cast<std::size_t>(x)]; }
  double radius(int x) const { return radii_[static_cast<std::size_t>(x)]; }

 private:
  std::vector<Vec3d> centres_;
  std::vector<double> radii_;
};

/// A mean, and what it weighs.
struct Mean {
  std::vector<double> values;
  double weight;
};

/// Beyond `angle` of a direction there is nothing.
struct Support {
  Vec3d direction;
  double angle;
};

constexpr Support kEverywhere{{0, 0, 1}, 10};

Mean mean_of(const Map& map, const std::function<double(const Vec3d&)>& weight, const Support& support,
             int points) {
  map.check();
  require(points >= 1, "a grid of no points");
  const auto& p = map.parameterization;
  const Matrix3 to_world = transpose(map.orientation);
  const Vec3d from = map.orientation * support.direction;
  const std::size_t channels = static_cast<std::size_t>(map.channels());
  const std::size_t stride = channels + 1;  // the last: the weights' sum
  const int rows = map.charts() * map.height();
  std::vector<double> sums(static_cast<std::size_t>(rows) * stride);
  tbb::parallel_for(tbb::blocked_range<int>(0, rows), [&](const auto& range) {
    for (int row = range.begin(); row != range.end(); ++row) {
      const int chart = row / map.height(), y = row % map.height();
      double* sum = sums.data() + static_cast<std::size_t>(row) * stride;
      const RowCaps caps(p, map, chart, y);
      for (int x = 0; x < map.width(); ++x) {
        if (angle_between(caps.centre(x), from) > support.angle + caps.radius(x)) continue;
        double texel = 0;
        for (int k = 0; k < points * points; ++k) {
          const double u = (x + (k % points + 0.5) / points) / map.width();
          const double v = (y + (k / points + 0.5) / points) / map.height();
          if (!p.valid(chart, u, v)) continue;
          texel += weight(to_world * p.to_sphere(chart, u, v)) * p.solid_angle_density(chart, u, v);
        }
        const float* radiance = map.level.chart(chart).at(x, y);
        for (std::size_t c = 0; c < channels; ++c) sum[c] += texel * static_cast<double>(radiance[c]);
        sum[channels] += texel;
      }
    }
  });
  std::vector<double> mean(channels);
  double total = 0;
  for (std::size_t row = 0; row < static_cast<std::size_t>(rows); ++row) {
    for (std::size_t c = 0; c < channels; ++c) mean[c] += sums[row * stride + c];
    total += sums[row * stride + channels];
  }
  for (double& each : mean) each = total > 0 ? each / total : 0;
  return {std::move(mean), total};
}

}  // namespace

double vmf_concentration(double sigma) {
  require(sigma > 0, "a Gaussian's width is not above 0");
  const double wanted = -std::expm1(-sigma * sigma);
  double low = -30, high = 80;  // of log κ; what is missing falls as κ grows
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (missing_cosine(std::exp(middle)) > wanted ? low : high) = middle;
  }
  return std::exp(low);
}

ConeWeight::ConeWeight(const EllipticalCone& cone) {
  require_sound(fault_of(cone));
  const double narrow = static_cast<double>(cone.narrow), wide = static_cast<double>(cone.wide);
  require(narrow > 0, "a cone without width has no weight");
  concentration_ = vmf_concentration(narrow);
  // ∫ exp(κ (cos θ − 1)) dω = 2π (1 − exp(−2κ))/κ
  scale_ = concentration_ / (-2 * kPi * std::expm1(-2 * concentration_));
  const Vec3d direction = normalize(to_double(cone.direction));
  const TangentPlane plane =
      wide > narrow ? TangentPlane(direction, to_double(cone.axis)) : TangentPlane(direction);
  pole_ = plane.down;
  const double spread = std::sqrt(std::max(0.0, wide * wide - narrow * narrow));
  // exp(κ (cos θ − 1)) is below 1e-20 beyond 1 − cos θ = 46/κ.
  const double chord = std::sqrt(46 / (2 * concentration_));
  reach_ = (chord < 1 ? 2 * std::asin(chord) : kPi) + 9 * spread;
  if (!(spread > 1e-3 * narrow)) {
    steps_.push_back({direction, 1});
    return;
  }
  // Steps of at most half of either width, a whole number of them around; beyond 9σ there is nothing, and
  // what goes around more than once is added up.
  const int around = static_cast<int>(std::ceil(2 * kPi / std::min({0.5 * narrow, 0.5 * spread, kPi / 8})));
  const double step = 2 * kPi / around;
  const int reach = static_cast<int>(std::ceil(9 * spread / step));
  std::vector<double> shares(static_cast<std::size_t>(around));
  double total = 0;
  for (int i = -reach; i <= reach; ++i) {
    const double x = i * step / spread, share = std::exp(-0.5 * x * x);
    shares[static_cast<std::size_t>((i % around + around) % around)] += share;
    total += share;
  }
  for (int i = 0; i < around; ++i) {
    const double share = shares[static_cast<std::size_t>(i)] / total;
    if (!(share > 0)) continue;
    steps_.push_back({std::cos(i * step) * direction + std::sin(i * step) * plane.right, share});
  }
}

double ConeWeight::operator()(const Vec3d& direction) const {
  // Nowhere on the circle is nearer than this.
  const double off = dot(pole_, direction);
  const double nearest = std::sqrt(std::max(0.0, 1 - off * off));
  if (concentration_ * (1 - nearest) > 50) return 0;
  double sum = 0;
  for (const Step& step : steps_) {
    // 1 − cos θ without cancellation.
    const Vec3d chord = direction - step.direction;
    sum += step.share * std::exp(-0.5 * concentration_ * dot(chord, chord));
  }
  return scale_ * sum;
}

std::vector<double> weighted_mean(const Map& map, const std::function<double(const Vec3d&)>& weight,
                                  int points) {
  return mean_of(map, weight, kEverywhere, points).values;
}

std::vector<double> look_up_reference(const Map& map, const EllipticalCone& cone, int points) {
  const ConeWeight weight(cone);
  return mean_of(map, weight, {normalize(to_double(cone.direction)), weight.reach()}, points).values;
}

std::vector<double> look_up_reference(const Map& map, const QuadCone& cone, int points) {
  require_sound(fault_of(cone));
  // On the plane that touches the sphere in the middle, great circles are straight lines.
  Vec3d sum{0, 0, 0};
  for (const Vec3d& corner : cone.corners) sum = sum + normalize(corner);
  const TangentPlane plane(normalize(sum));
  const auto on_plane = [&](const Vec3d& d) {
    const double away = dot(plane.normal, d);
    return PlanePoint{dot(plane.right, d) / away, dot(plane.down, d) / away};
  };
  PlanePoint corners[4];
  for (std::size_t i = 0; i < 4; ++i) corners[i] = on_plane(cone.corners[i]);
  const auto inside = [&](const Vec3d& d) {
    if (!(dot(plane.normal, d) > 0)) return 0.0;
    const PlanePoint at = on_plane(d);
    bool odd = false;
    for (std::size_t i = 0; i < 4; ++i) {
      const PlanePoint &a = corners[i], &b = corners[(i + 1) % 4];
      if ((a.y > at.y) == (b.y > at.y)) continue;
      if (at.x < a.x + (at.y - a.y) / (b.y - a.y) * (b.x - a.x)) odd = !odd;
    }
    return odd ? 1.0 : 0.0;
  };
  double reach = 0;
  for (const Vec3d& corner : cone.corners) reach = std::max(reach, angle_between(plane.normal, corner));
  Mean mean = mean_of(map, inside, {plane.normal, 1.01 * reach}, points);
  require(mean.weight > 0, "a cone has no area, or one too small for so few points");
  return mean.values;
}

}  // namespace welkin
