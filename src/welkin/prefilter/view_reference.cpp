#include "welkin/prefilter/view_reference.h"

#include <algorithm>
#include <cmath>

#include "welkin/base/error.h"
#include "welkin/map/texel_points.h"

namespace welkin {
namespace {

/// Subdivisions of a texel into four, at most.
constexpr int kMaxDepth = 7;

/// BRDF · cosine in the world.
class Reflection {
 public:
  Reflection(const brdf::AnyBrdf& brdf, const Vec3d& normal, const Vec3d& view)
      : brdf_(brdf), normal_(normal) {
    const Vec3d level = view - dot(view, normal) * normal;
    const Vec3d any = std::fabs(normal.y) < 0.9 ? Vec3d{0, 1, 0} : Vec3d{1, 0, 0};
    along_ = length(level) > 1e-12 ? normalize(level) : normalize(cross(any, normal));
    across_ = cross(normal, along_);
    view_ = local(view);
  }
  double at(const Vec3d& light) const {
    const Vec3d l = local(light);
    return l.z > 0 ? brdf_.value(view_, l) * l.z : 0.0;
  }

 private:
  Vec3d local(const Vec3d& d) const { return {dot(d, along_), dot(d, across_), dot(d, normal_)}; }
  const brdf::AnyBrdf& brdf_;
  Vec3d normal_, along_, across_, view_;
};

/// The integral over one cell, subdivided.
class CellIntegral {
 public:
  CellIntegral(const sphere::AnyParameterization& p, const Matrix3& to_world, const Reflection& reflection,
               double tolerance)
      : p_(p), to_world_(to_world), reflection_(reflection), tolerance_(tolerance) {}

  double over(const ChartCell& cell, int depth) const {
    std::vector<TexelPoint> points;
    append_gauss_points(p_, cell, points);
    double sum = 0, least = 1e300, most = 0, area = 0;
    for (const TexelPoint& point : points) {
      const double value = reflection_.at(to_world_ * point.direction);
      sum += value * point.solid_angle;
      area += point.solid_angle;
      least = std::min(least, value);
      most = std::max(most, value);
    }
    if (depth >= kMaxDepth || !coarse(least, most, area)) return sum;
    sum = 0;
    for (int k = 0; k < 4; ++k) sum += over(cell.part(k % 2, 2, k / 2, 2), depth + 1);
    return sum;
  }
  /// What four points leave out goes with the square of how much the values differ.
  bool coarse(double least, double most, double area) const {
    const double varies = most > 0 ? (most - least) / most : 0;
    return most * area * varies * varies > tolerance_;
  }

 private:
  const sphere::AnyParameterization& p_;
  const Matrix3& to_world_;
  const Reflection& reflection_;
  double tolerance_;
};

}  // namespace

ViewReference::ViewReference(const Map& source)
    : parameterization_(source.parameterization),
      to_world_(transpose(source.orientation)),
      size_{source.width(), source.height()},
      channels_(source.channels()) {
  source.check();
  CellLimits limits = texel_limits(parameterization_, size_);
  limits.side = mean_texel(parameterization_, size_);
  std::vector<TexelPoint> points;
  for (int chart = 0; chart < source.charts(); ++chart) {
    for (int y = 0; y < size_.height; ++y) {
      const std::vector<TexelKind> kinds = texel_kinds(parameterization_, size_, chart, y);
      for (int x = 0; x < size_.width; ++x) {
        const TexelKind kind = kinds[static_cast<std::size_t>(x)];
        if (kind == TexelKind::outside) continue;
        points.clear();
        const ChartCell cell = texel_cell(size_, chart, x, y);
        if (kind == TexelKind::plain) {
          append_gauss_points(parameterization_, cell, points);
        } else {
          append_points(parameterization_, cell, limits, points);
        }
        texels_.push_back({points_.size(), points.size(), kind == TexelKind::plain ? chart : -1, x, y});
        for (const TexelPoint& point : points)
          points_.push_back({to_world_ * point.direction, point.solid_angle});
        const float* radiance = source.level.chart(chart).at(x, y);
        radiance_.insert(radiance_.end(), radiance, radiance + channels_);
      }
    }
  }
}

void ViewReference::evaluate(const brdf::AnyBrdf& brdf, const Vec3d& normal, const Vec3d& view,
                             std::span<double> radiance, double tolerance) const {
  require(!brdf.is_mirror(), "a mirror reflects one direction: look it up");
  require(dot(normal, view) > 0, "the viewer is above the surface");
  const auto channels = static_cast<std::size_t>(channels_);
  require(radiance.size() >= channels, "a result has room for all channels");
  const Reflection reflection(brdf, normal, view);
  const CellIntegral integral(parameterization_, to_world_, reflection, tolerance);
  std::fill(radiance.begin(), radiance.end(), 0.0);
  double whole = 0;
  for (std::size_t i = 0; i < texels_.size(); ++i) {
    const Texel& texel = texels_[i];
    double sum = 0, least = 1e300, most = 0, area = 0;
    for (std::size_t k = texel.first; k < texel.first + texel.count; ++k) {
      const double value = reflection.at(points_[k].direction);
      sum += value * points_[k].solid_angle;
      area += points_[k].solid_angle;
      least = std::min(least, value);
      most = std::max(most, value);
    }
    if (texel.chart >= 0 && integral.coarse(least, most, area))
      sum = integral.over(texel_cell(size_, texel.chart, texel.x, texel.y), 0);
    if (sum == 0) continue;
    whole += sum;
    for (std::size_t c = 0; c < channels; ++c)
      radiance[c] += sum * static_cast<double>(radiance_[i * channels + c]);
  }
  for (std::size_t c = 0; c < channels; ++c) radiance[c] = whole > 0 ? radiance[c] / whole : 0.0;
}

}  // namespace welkin
