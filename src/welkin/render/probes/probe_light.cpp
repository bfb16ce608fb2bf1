#include "welkin/render/probes/probe_light.h"

#include <algorithm>
#include <cmath>

#include "welkin/base/error.h"
#include "welkin/base/number_text.h"

namespace welkin::scene {
namespace {

constexpr std::string_view kSpecular = "specular-";
constexpr double kLeastSeen = 0.05, kBehindSurface = 0.2;

/// A place along one axis, in probes: between `low` and the one after it, where there is one.
struct Between {
  int low, high;
  double part;
};

Between between(double at, double least, double spacing, int count) {
  if (count == 1 || !(spacing > 0)) return {0, 0, 0};
  const double cell = std::clamp((at - least) / spacing - 0.5, 0.0, count - 1.0);
  const int low = std::min(static_cast<int>(cell), count - 2);
  return {low, low + 1, cell - low};
}

}  // namespace

ProbeLight::ProbeLight(const ProbeGrid& grid, const ProbeLookUp& how)
    : grid_(grid),
      how_(how),
      bias_(0),
      octahedral_(sphere::AnyParameterization::make("octahedral")),
      diffuse_(grid.atlas("diffuse")),
      depth_(grid.atlas("depth")) {
  require(std::isfinite(how.normal_bias), "the bias along the normal is finite");
  const Vec3d spacing = grid.probes.spacing();
  double shortest = std::numeric_limits<double>::infinity();
  for (const double step : {spacing.x, spacing.y, spacing.z})
    if (step > 0) shortest = std::min(shortest, step);
  bias_ = std::isfinite(shortest) ? how.normal_bias * shortest : 0;
  if (const ProbeAtlas* radiance = grid.atlas("radiance")) levels_.push_back({0, radiance});
  for (const ProbeAtlas& atlas : grid.atlases)
    if (atlas.name.starts_with(kSpecular))
      levels_.push_back({parse_number(atlas.name.substr(kSpecular.size())).value_or(1), &atlas});
}

void ProbeLight::look_up(const ProbeAtlas& atlas, std::span<const ProbeWeight> weights,
                         const Vec3d& direction, std::span<float> values) const {
  const auto channels = atlas.channels.size();
  require(values.size() >= channels, "there is room for all channels");
  std::fill_n(values.begin(), channels, 0.0f);
  const auto at = octahedral_.from_sphere(grid_.orientation * direction);
  const double x = at.u * atlas.size - 0.5 + atlas.border, y = at.v * atlas.size - 0.5 + atlas.border;
  const int i = std::clamp(static_cast<int>(std::floor(x)), 0, atlas.pitch() - 2),
            j = std::clamp(static_cast<int>(std::floor(y)), 0, atlas.pitch() - 2);
  const double fx = x - i, fy = y - j;
  const int columns = grid_.probes.counts[0];
  for (const ProbeWeight& each : weights) {
    if (!(each.weight > 0)) continue;
    const int left = each.index % columns * atlas.pitch() + i, top = each.index / columns * atlas.pitch() + j;
    const float *a = atlas.image.at(left, top), *b = atlas.image.at(left, top + 1);
    for (std::size_t c = 0; c < channels; ++c)
      values[c] += static_cast<float>(
          each.weight *
          ((1 - fy) * ((1 - fx) * static_cast<double>(a[c]) + fx * static_cast<double>(a[c + channels])) +
           fy * ((1 - fx) * static_cast<double>(b[c]) + fx * static_cast<double>(b[c + channels]))));
  }
}

/// The chance that a probe sees what lies `from` it, at that distance.
double ProbeLight::seen(int index, const Vec3d& from, double distance) const {
  const ProbeWeight whole{index, 1};
  float moments[2];
  look_up(*depth_, {&whole, 1}, from, moments);
  const double mean = static_cast<double>(moments[0]), past = std::min(distance, grid_.farthest) - mean;
  if (past <= 0) return 1;
  const double variance = std::max(0.0, static_cast<double>(moments[1]) - mean * mean);
  const double chance = variance / (variance + past * past);
  return std::max(kLeastSeen, chance * chance * chance);
}

std::array<ProbeWeight, 8> ProbeLight::weights(const Vec3d& position, const Vec3d& normal) const {
  const ProbeBox& probes = grid_.probes;
  const Vec3d spacing = probes.spacing(), least = probes.box.least;
  const Vec3d place = position + bias_ * normal;
  const Between x = between(place.x, least.x, spacing.x, probes.counts[0]),
                y = between(place.y, least.y, spacing.y, probes.counts[1]),
                z = between(place.z, least.z, spacing.z, probes.counts[2]);
  std::array<ProbeWeight, 8> weights{};
  std::array<double, 8> trilinear{};
  double sum = 0, plain = 0;
  for (std::size_t k = 0; k < 8; ++k) {
    const bool right = (k & 1) != 0, up = (k & 2) != 0, ahead = (k & 4) != 0;
    const int px = right ? x.high : x.low, py = up ? y.high : y.low, pz = ahead ? z.high : z.low;
    weights[k].index = probes.index(px, py, pz);
    trilinear[k] = (right ? x.part : 1 - x.part) * (up ? y.part : 1 - y.part) * (ahead ? z.part : 1 - z.part);
    plain += trilinear[k];
    if (grid_.inside(weights[k].index) || !(trilinear[k] > 0)) continue;
    const Vec3d probe = probes.position(px, py, pz);
    const Vec3d to_probe = probe - position, to_place = place - probe;
    double weight = trilinear[k];
    if (const double length_to = length(to_probe); how_.facing && length_to > 0) {
      const double wrapped = (1 + dot(normal, to_probe) / length_to) / 2;
      weight *= wrapped * wrapped + kBehindSurface;
    }
    if (const double distance = length(to_place); how_.visibility && depth_ != nullptr && distance > 0)
      weight *= seen(weights[k].index, to_place, distance);
    weights[k].weight = weight;
    sum += weight;
  }
  for (std::size_t k = 0; k < 8; ++k)
    weights[k].weight = sum > 0 ? weights[k].weight / sum : trilinear[k] / plain;
  return weights;
}

Rgb ProbeLight::diffuse(const Vec3d& position, const Vec3d& normal) const {
  require(diffuse_ != nullptr, "the grid has no diffuse light");
  Rgb light{};
  look_up(*diffuse_, weights(position, normal), normal, light);
  return light;
}

Rgb ProbeLight::specular(const Vec3d& position, const Vec3d& normal, const Vec3d& direction,
                         double roughness) const {
  require(!levels_.empty(), "the grid has no radiance, and no level of roughness");
  const std::array<ProbeWeight, 8> parts = weights(position, normal);
  const auto above = std::find_if(levels_.begin(), levels_.end(),
                                  [&](const Level& level) { return level.roughness >= roughness; });
  Rgb finer{}, rougher{};
  if (above == levels_.begin() || above == levels_.end()) {
    look_up(*(above == levels_.end() ? levels_.back() : *above).atlas, parts, direction, finer);
    return finer;
  }
  const Level &low = above[-1], &high = *above;
  look_up(*low.atlas, parts, direction, finer);
  look_up(*high.atlas, parts, direction, rougher);
  const auto part = static_cast<float>((roughness - low.roughness) / (high.roughness - low.roughness));
  for (std::size_t c = 0; c < 3; ++c) finer[c] += part * (rougher[c] - finer[c]);
  return finer;
}

}  // namespace welkin::scene
