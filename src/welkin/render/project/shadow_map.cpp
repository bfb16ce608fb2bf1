#include "welkin/render/project/shadow_map.h"

#include <algorithm>
#include <cmath>

#include "welkin/base/error.h"
#include "welkin/base/parallel.h"
#include "welkin/map/borders.h"
#include "welkin/math/vec_precision.h"
#include "welkin/render/project/project.h"

namespace welkin::scene {
namespace {

/// Of a surface within a texel: tan of the angle between its normal and the ray.
constexpr double kEdgeSlope = 1.5;
constexpr int kSmallest = 16, kLargest = 16384;
/// Of a distance's square: moments of floats differ by this where there is no variance.
constexpr double kLeastVariance = 1e-5;

/// Shows nothing: a map of distances needs no light.
class Unlit : public Shading {
 public:
  void shade(std::span<const Surface>, std::span<Rgb> radiance) const override {
    std::fill(radiance.begin(), radiance.end(), Rgb{});
  }
};

/// Distances of the first opaque surface along each texel's middle; infinite where there is none.
Map distances_of(const TracedScene& scene, const Vec3d& light, int size) {
  Map map(sphere::AnyParameterization::make("octahedral"), size, size, 1);
  map.channel_names = {"Z"};
  parallel_for(size, [&](int y) {
    std::vector<Ray> rays;
    std::vector<Hit> hits(static_cast<std::size_t>(size));
    for (int x = 0; x < size; ++x)
      rays.push_back(
          {to_float(light), to_float(map.parameterization.to_sphere(0, (x + 0.5) / size, (y + 0.5) / size))});
    scene.closest(rays, hits, Coherence::close);
    for (int x = 0; x < size; ++x)
      map.level.chart(0).at(x, y)[0] = std::min(hits[static_cast<std::size_t>(x)].distance, 1e30f);
  });
  fill_borders(map);
  return map;
}

Map moments_of(const TracedScene& scene, const Vec3d& light, int size) {
  const Unlit unlit;
  ProjectOptions options;
  options.samples = 4;
  options.shade_once = true;
  options.depth = DepthChannels::moments;
  const Map seen = project({scene, unlit}, light,
                           {sphere::AnyParameterization::make("octahedral"), {size, size}}, options);
  Map map(seen.parameterization, size, size, 2);
  map.channel_names = {"Z", "Z2"};
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x)
      std::copy_n(seen.level.chart(0).at(x, y) + 3, 2, map.level.chart(0).at(x, y));
  fill_borders(map);
  return map;
}

}  // namespace

ShadowMap::ShadowMap(const TracedScene& scene, const Vec3d& light, const ShadowMapOptions& options)
    : light_(light), options_(options) {
  require(options.size >= kSmallest && options.size <= kLargest,
          "a shadow map has 16 to 16384 texels a side");
  require(options.bias >= 0 && options.bias < 1,
          "the bias of shadows is a share of distances, 0 or more and under 1");
  require(std::abs(light.x) <= 1e30 && std::abs(light.y) <= 1e30 && std::abs(light.z) <= 1e30,
          "a light is at a finite place, at most 1e30 from the origin");
  map_ = std::make_shared<const Map>(options.moments ? moments_of(scene, light, options.size)
                                                     : distances_of(scene, light, options.size));
}

double ShadowMap::visibility(const Vec3d& position, const Vec3d& normal) const {
  const Vec3d from_light = position - light_;
  if (!(dot(from_light, from_light) > 0)) return 1;
  return options_.moments ? bounded(from_light) : compared(from_light, normal);
}

/// Percentage-closer filtering (Reeves, Salesin & Cook 1987) of 2×2 texels.
double ShadowMap::compared(const Vec3d& from_light, const Vec3d& normal) const {
  const int size = options_.size;
  const auto at = map_->parameterization.from_sphere(from_light);
  const double x = at.u * size - 0.5, y = at.v * size - 0.5;
  const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
  const double fx = x - i, fy = y - j, distance = length(from_light), plane = dot(normal, from_light);
  const ImageView<const float> texels = std::as_const(map_->level).chart(0);
  // In a concave edge the texel's middle may be on the other side, which comes nearer.
  const double least_share = 1 - options_.bias - kEdgeSlope * std::sqrt(4 * kPi) / size;
  double seen = 0;
  for (int dy = 0; dy < 2; ++dy) {
    for (int dx = 0; dx < 2; ++dx) {
      const Vec3d direction =
          map_->parameterization.to_sphere(0, (i + dx + 0.5) / size, (j + dy + 0.5) / size);
      // Where the ray through the texel's middle meets the plane of the surface, if that is nearer.
      const double facing = dot(normal, direction), met = facing != 0 ? plane / facing : -1;
      const double there = met > 0 ? std::min(met, distance) : distance;
      const double kept = static_cast<double>(texels.at(i + dx, j + dy)[0]);
      const double weight = (dx == 1 ? fx : 1 - fx) * (dy == 1 ? fy : 1 - fy);
      if (kept >= least_share * there) seen += weight;
    }
  }
  return std::min(seen, 1.0);
}

double ShadowMap::bounded(const Vec3d& from_light) const {
  const int size = options_.size;
  const auto at = map_->parameterization.from_sphere(from_light);
  const double x = at.u * size - 0.5, y = at.v * size - 0.5;
  const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
  const double fx = x - i, fy = y - j;
  const ImageView<const float> texels = std::as_const(map_->level).chart(0);
  const auto read = [&](int channel) {
    const auto value = [&](int dx, int dy) {
      return static_cast<double>(texels.at(i + dx, j + dy)[channel]);
    };
    return (1 - fy) * ((1 - fx) * value(0, 0) + fx * value(1, 0)) +
           fy * ((1 - fx) * value(0, 1) + fx * value(1, 1));
  };
  const double mean = read(0), past = (1 - options_.bias) * length(from_light) - mean;
  if (past <= 0) return 1;
  const double variance = std::max(read(1) - mean * mean, kLeastVariance * mean * mean);
  return variance / (variance + past * past);
}

}  // namespace welkin::scene
